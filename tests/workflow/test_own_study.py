"""The folder that `riserstudy new` makes: complete, valid, with the rules of the package."""

import json
import os
import re
import sys
from pathlib import Path
from types import SimpleNamespace

import jsonschema
import pytest
import xarray as xr
from edits import forget_sources
from planning import dry_run, jobs_in
from ruamel.yaml import YAML

from riserstudy.chapters import checks_of
from riserstudy.chapters.derive import derive
from riserstudy.chapters.draw import draw
from riserstudy.chapters.measure import measure
from riserstudy.errors import InputError
from riserstudy.grading.grade import grade
from riserstudy.grading.published import read_published
from riserstudy.jobs.workplan import Workplan
from riserstudy.report.of_chapters import section_of, tiles_of
from riserstudy.study.config import RULES
from riserstudy.study.new import TEMPLATE, new_study
from riserstudy.study.schemas import schema_files

pytestmark = pytest.mark.long

ROOT = Path(__file__).parents[2]
EDITABLE = ["config/config.yaml", "config/studies/example.yaml", "config/scenes/riser.yaml"]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    new_study(tmp_path / "my study")
    monkeypatch.chdir(tmp_path / "my study")
    monkeypatch.syspath_prepend(tmp_path / "my study")
    yield tmp_path / "my study"
    for name in [name for name in sys.modules if name.startswith("chapters.example")]:
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
        mine = {path.name for path in code[kind] if path.is_relative_to(chapter)}
        named = set() if kind == "grade" else {"variables.yaml"}
        assert mine == {f"{file}.py"} | named


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
        ("figures.a: the figure has no plot", "{caption: c, reads: [heave]}"),
        ("'heave' has 1", "{caption: c, reads: [heave], plot: heat map}"),
        ("a plot shows exactly one dataset", "{caption: c, reads: [heave, heave_and_current], plot: lines}"),
        ("has no effect without plot", "{caption: c, reads: [heave], of: [x]}"),
        ("pie", "{caption: c, reads: [heave], plot: pie}"),
        ("'moment' is not an output of a study", "{caption: c, reads: [heave], plot: lines, of: [moment]}"),
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
    with pytest.raises(InputError, match="'report' is a name that the workflow uses"):
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
    with pytest.raises(InputError, match=r"'a_b_c' is also the name of figure b_c of a"):
        Workplan.read(folder / "config", {"papers": ["a", "a_b"]}, only=[])
    assert Workplan.read(folder / "config", {"papers": ["a_b"]}, only=[]).figures()


def test_the_names_of_all_rules_are_taken():
    rules = (ROOT / "workflow/Snakefile", *(ROOT / "workflow/rules").glob("*.smk"), TEMPLATE / "Snakefile")
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


def test_a_folder_that_holds_something_is_left_alone(folder, commands):
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    code, _, said = commands("new", folder)
    assert code == 2
    assert "already contains files" in said
    assert before == {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_the_template_holds_nothing_but_what_git_has():
    assert {path.name for path in TEMPLATE.iterdir()} == {
        *("Snakefile", "README.md", "chapters", "config", "profiles")
    }
    assert not (Path(TEMPLATE) / "config/schemas").exists()


def page_code():
    """What a page tells to write, by file; in study files, below what is there."""
    text = (ROOT / "docs/own_study.md").read_text("utf-8")
    text = text.partition("\n## Datasets and report parts by your code\n")[2].partition("\n## ")[0]
    code = dict(re.findall(r"```python\n# (\S+)\n(.*?)```", text, re.DOTALL))
    (study,) = re.findall(r"```yaml\n(.*?)```", text, re.DOTALL)
    return code | {STUDY: study}


FIGURE = """

def mesh_study(mesh_study):
    figure, (ax,) = panels()
    ax.plot(mesh_study["elements"], mesh_study["period"])
    ax.set_title("the period hardly depends on the mesh")
    return figure
"""


@pytest.fixture
def measuring(folder):
    """The folder with a dataset that its chapter measures, as the page has it, and a figure of it."""
    for name, text in page_code().items():
        with (folder / name).open("a") as file:
            file.write(f"\n{text}")
    with (folder / "chapters/example/figures.py").open("a") as file:
        file.write(FIGURE)
    text = (folder / STUDY).read_text()
    drawn = "figures:\n  mesh_study: {caption: c, reads: [mesh_study]}\n"
    (folder / STUDY).write_text(text.replace("figures:\n", drawn))
    return folder


def test_a_chapter_measures_a_dataset_and_tells_of_it_in_the_report(measuring):
    plan = Workplan.read(measuring / "config", {})
    model, setting = plan.measured("example", "mesh_study"), plan.setting(1)
    found = measure("example", "mesh_study", model, setting)
    assert found.attrs["title"].endswith("first natural period over the number of segments")
    assert (found["period"] > 0.0).all()
    drawn = [
        SimpleNamespace(
            paper="example", name="mesh_study", anchor="example-mesh_study",
            picture=picture_of_title(draw("example", "mesh_study", {"mesh_study": found})),
        )
    ]  # fmt: skip
    (tile,) = tiles_of("example", {"mesh_study": found}, drawn)
    assert int(tile.number) in (10, 20)
    assert tile.figure == "example-mesh_study"
    (table,) = section_of("example", {"mesh_study": found}).tables
    assert [row[0].order for row in table.rows] == [10, 20, 40]


def picture_of_title(figure):
    return SimpleNamespace(title=figure.axes[0].get_title())


def test_a_measured_dataset_is_planned_with_its_figure(measuring):
    status, said, jobs = planned(measuring, "example_mesh_study")
    assert status == 0, said
    assert {job for job in jobs if "kernels" not in job} == {
        "measure example/mesh_study",
        "draw example/mesh_study",
    }


@pytest.mark.parametrize(
    "file, old, new",
    [
        ("config/scenes/riser.yaml", "900 kg/m", "910 kg/m"),
        (STUDY, "elements: [10, 20, 40]", "elements: [10, 20]"),
        ("chapters/example/measured.py", '["natural_period"][0]', '["natural_period"][1]'),
    ],
)
def test_an_edit_of_what_is_measured_measures_anew(measuring, file, old, new):
    before = Workplan.read(measuring / "config", {}).measured_digest("example", "mesh_study")
    text = (measuring / file).read_text()
    assert text.count(old) == 1
    (measuring / file).write_text(text.replace(old, new))
    forget_sources()
    again = Workplan.read(measuring / "config", {}).measured_digest("example", "mesh_study")
    assert again != before


def test_an_edit_of_what_a_chapter_tells_makes_the_report_anew(measuring):
    before = Workplan.read(measuring / "config", {}, only=[]).report_digest
    with (measuring / "chapters/example/report.py").open("a") as file:
        file.write("more = 1\n")
    forget_sources()
    assert Workplan.read(measuring / "config", {}, only=[]).report_digest != before


LISTED = "    elements: [10, 20, 40]\n"


@pytest.mark.parametrize(
    "said, old, new",
    [
        ("measured.mesh_study.elements", LISTED, "    elements: many\n"),
        ("measured.mesh_study.colour: unknown key", LISTED, f"{LISTED}    colour: red\n"),
        ("measured.mesh_study.elements: missing", LISTED, ""),
        ("models.py has no 'mash'", "  mesh_study:\n    caption", "  mash:\n    caption"),
    ],
)
def test_what_does_not_fit_the_model_of_a_chapter_stops_before_any_job(measuring, said, old, new):
    text = (measuring / STUDY).read_text()
    assert text.count(old) == 1
    (measuring / STUDY).write_text(text.replace(old, new))
    with pytest.raises(InputError, match=re.escape(said)):
        Workplan.read(measuring / "config", {}, only=[])


def test_a_model_without_a_function_that_measures_is_refused(measuring):
    (measuring / "chapters/example/measured.py").unlink()
    with pytest.raises(InputError, match=r"chapters/example/measured\.py defines no function mesh_study"):
        Workplan.read(measuring / "config", {}, only=[])
