"""The folder that `riserstudy new` makes: complete, valid, with the rules of the package."""

import json
import os
import re
import sys
from pathlib import Path

import jsonschema
import pytest
import xarray as xr
from planning import dry_run, jobs_in
from ruamel.yaml import YAML

from riserstudy.chapters import checks_of
from riserstudy.chapters.derive import derive
from riserstudy.chapters.draw import draw
from riserstudy.cli import main
from riserstudy.errors import InputError
from riserstudy.grading.grade import grade
from riserstudy.grading.published import read_published
from riserstudy.jobs.workplan import Workplan
from riserstudy.study.config import RULES
from riserstudy.study.new import TEMPLATE, new_study
from riserstudy.study.schemas import schema_files

ROOT = Path(__file__).parents[2]
EDITABLE = ["config/config.yaml", "config/studies/example.yaml", "config/scenes/riser.yaml"]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    new_study(tmp_path / "my study")
    monkeypatch.chdir(tmp_path / "my study")
    monkeypatch.syspath_prepend(tmp_path / "my study")
    yield tmp_path / "my study"
    for name in [name for name in sys.modules if name.split(".")[0] == "chapters"]:
        del sys.modules[name]


def planned(folder, *arguments):
    """What a plain `snakemake -n` says it would do."""
    status, said = dry_run(folder, os.environ, *arguments)
    return status, said, jobs_in(said)


def test_a_plain_snakemake_plans_datasets_figures_grading_and_the_report(folder):
    status, said, jobs = planned(folder)
    assert status == 0, said
    figures = ["moment_over_heave", "stroke_over_time", "surge_and_current", "swing_over_heave"]
    assert {job for job in jobs if "kernels" not in job} == {
        *(f"simulate example/{name}" for name in ("heave", "heave_and_current")),
        *(f"draw example/{name}" for name in figures),
        "derive example/tension_swing",
        "grade example",
        "join the graded tables",
        "make the results database",
        "make the report",
    }


def test_without_figures_every_fitting_plot_is_drawn(folder):
    without(folder, "figures")
    status, said, jobs = planned(folder)
    assert status == 0, said
    plots = ["heave_lines", "heave_envelope", "heave_time_series", "heave_and_current_heat_map"]
    plots += ["heave_and_current_envelope", "heave_and_current_time_series"]
    assert {job for job in jobs if job.startswith("draw")} == {f"draw example/{n}" for n in plots}


def without(folder, *sections):
    """Take sections out of the example's study."""
    yaml = YAML(pure=True)
    tree = yaml.load(folder / STUDY)
    for section in sections:
        del tree[section]
    yaml.dump(tree, folder / STUDY)


def test_an_edit_of_an_own_chapter_makes_stale_what_imports_it(folder):
    plan = Workplan.read(folder / "config", {})
    code = {"figure": plan.figure_code("example", "swing_over_heave")}
    code["derived"] = plan.derived_code("example", "tension_swing")
    code["grade"] = plan.grade_code("example")
    chapter = (folder / "chapters/example").resolve()
    for kind, file in (("figure", "figures"), ("derived", "derived"), ("grade", "claims")):
        mine = {path for path in code[kind] if path.is_relative_to(chapter)}
        assert mine == {chapter / f"{file}.py"}


def test_an_own_chapter_derives_draws_and_judges(folder):
    """With invented runs: a swing that grows by a power of heave."""
    heave = xr.Dataset(
        {
            "effective_tension_max": (("heave_amplitude", "s_node"), [[0.0, 1e3], [0.0, 9e3]]),
            "effective_tension_min": (("heave_amplitude", "s_node"), [[0.0, -1e3], [0.0, -9e3]]),
        },
        {"heave_amplitude": [1.0, 3.0], "s_node": [0.0, 9.0]},
    )
    found = derive("example", "tension_swing", {"heave": heave})
    assert found["tension_swing"].values.tolist() == [1e3, 9e3]
    figure = draw("example", "swing_over_heave", {"tension_swing": found})
    assert figure.axes[0].get_xlabel() == "heave amplitude (m)"
    file = read_published(folder / "config", "example", {"tension_swing"})
    (row,) = grade(file, {"tension_swing": found}, checks_of("example"))
    assert (row.verdict, row.simulated) == ("holds", pytest.approx(3.0))


STUDY = "config/studies/example.yaml"


@pytest.mark.parametrize(
    "said, added",
    [
        ("figures.a: nothing says how to draw it", "{caption: c, reads: [heave]}"),
        ("'heave' has 1 axes", "{caption: c, reads: [heave], plot: heat map}"),
        ("reads one dataset", "{caption: c, reads: [heave, heave_and_current], plot: lines}"),
        ("needs a plot", "{caption: c, reads: [heave], of: [x]}"),
        ("pie", "{caption: c, reads: [heave], plot: pie}"),
        ("studies have no 'moment'", "{caption: c, reads: [heave], plot: lines, of: [moment]}"),
    ],
)
def test_a_figure_that_cannot_be_meant_stops_before_any_job(folder, said, added):
    without(folder, "figures")
    with (folder / STUDY).open("a") as file:
        file.write(f"figures: {{a: {added}}}\n")
    status, out, _ = planned(folder)
    assert status == 2
    assert f"riserstudy: {STUDY}: figures.a" in out
    assert said in out


def test_a_chapter_that_would_need_code_is_refused(folder):
    (folder / "chapters/example/claims.py").unlink()
    with pytest.raises(InputError, match=r"chapters/example/claims\.py defines no function"):
        Workplan.read(folder / "config", {})


def test_a_chapter_cannot_take_the_name_of_a_rule(folder):
    with pytest.raises(InputError, match="'report' is the name of a rule"):
        Workplan.read(folder / "config", {"papers": ["report"]}, only=[])


def test_targets_of_two_chapters_cannot_have_one_name(folder):
    """``a`` with a figure ``b_c``, and ``a_b`` with a figure ``c``."""
    for paper, figure in (("a", "b_c"), ("a_b", "c")):
        text = (
            f"paper: {paper}\nstudies: {{one: {{scene: scenes/riser.yaml, caption: c, "
            "axes: {kind: {plain: {}}}}}\n"
            f"figures: {{{figure}: {{caption: c, reads: [one], plot: envelope}}}}\n"
        )
        (folder / f"config/studies/{paper}.yaml").write_text(text, "utf-8")
    with pytest.raises(InputError, match=r"'a_b_c' it is figure b_c of a, too"):
        Workplan.read(folder / "config", {"papers": ["a", "a_b"]}, only=[])
    assert Workplan.read(folder / "config", {"papers": ["a_b"]}, only=[]).figures()


def test_the_names_of_all_rules_are_taken():
    rules = (
        ROOT / "workflow/Snakefile",
        *(ROOT / "workflow/rules").glob("*.smk"),
        TEMPLATE / "Snakefile",
    )
    found = {name for path in rules for name in re.findall(r"^rule (\w+):", path.read_text(), re.M)}
    assert found == RULES


@pytest.mark.parametrize("name", EDITABLE)
def test_the_first_line_points_editors_at_a_schema_that_fits(folder, name):
    first = (folder / name).read_text().splitlines()[0]
    target = re.fullmatch(r"# yaml-language-server: \$schema=(\S+)", first)[1]
    schema = json.loads(((folder / name).parent / target).read_text())
    jsonschema.validate(YAML(typ="safe", pure=True).load(folder / name), schema)
    assert (folder / name).parent.joinpath(target).name in schema_files()


def test_the_readme_names_every_file(folder):
    text = (folder / "README.md").read_text()
    for name in [*EDITABLE, "Snakefile", "config/schemas", "config/published/example.yaml"]:
        assert f"`{name}`" in text


def test_a_folder_that_holds_something_is_left_alone(folder, monkeypatch, capsys):
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    monkeypatch.setattr(sys, "argv", ["riserstudy", "new", str(folder)])
    with pytest.raises(SystemExit) as stopped:
        main()
    assert stopped.value.code == 2
    assert "is there already" in capsys.readouterr().err
    assert before == {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_the_template_holds_nothing_but_what_git_has():
    assert {path.name for path in TEMPLATE.iterdir()} == {
        *("Snakefile", "README.md", "chapters", "config", "profiles")
    }
    assert not (Path(TEMPLATE) / "config/schemas").exists()
