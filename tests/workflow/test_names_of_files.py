"""Names of studies and figures become names of files: two that would be one file are refused."""

import os
import random
from pathlib import Path

import pytest

from riserstudy.errors import InputError
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.jobs import configuration
from riserstudy.jobs.workplan import Workplan
from riserstudy.study.new import new_study

STUDY = Path("config/studies/example.yaml")


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    """A folder of one's own, where the study is that of the template."""
    new_study(tmp_path / "own")
    monkeypatch.chdir(tmp_path / "own")


def rename(old, new):
    """Give a figure or study another name, where it is defined."""
    text = STUDY.read_text()
    assert text.count(f"\n  {old}:") == 1
    STUDY.write_text(text.replace(f"\n  {old}:", f"\n  {new}:"))


def in_other_case(name, draw):
    """The name with some letters in upper case."""
    places = [k for k, c in enumerate(name) if c.islower()]
    some = {*draw.sample(places, draw.randint(1, len(places)))}
    return "".join(c.upper() if k in some else c for k, c in enumerate(name))


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize(
    "section, one, other",
    [("figures", "moment_over_heave", "surge_and_current"), ("studies", "heave", "heave_and_current")],
)
def test_names_in_another_case_are_refused_where_they_are_one_file(section, one, other, seed, monkeypatch):
    name = in_other_case(one, random.Random(seed))
    rename(other, name)
    if section == "studies":
        STUDY.write_text(STUDY.read_text().replace(f"reads: [{other}]", f"reads: [{name}]"))
    monkeypatch.setattr(configuration, "ignores_case", lambda file: True)
    with pytest.raises(InputError, match=f"{section}: '{one}' and '{name}' are the same file name"):
        Workplan.read(Path("config"), {})
    monkeypatch.setattr(configuration, "ignores_case", lambda file: False)
    Workplan.read(Path("config"), {})


def test_papers_in_another_case_are_refused_where_they_are_one_folder(monkeypatch):
    (STUDY.parent / "Example.yaml").write_text("paper: Example\nstudies: {}\n")
    papers = {"papers": ["example", "Example"]}
    Workplan.read(Path("config"), papers)
    monkeypatch.setattr(configuration, "ignores_case", lambda file: True)
    with pytest.raises(InputError, match="papers: 'example' and 'Example' are the same file name"):
        Workplan.read(Path("config"), papers)


def test_a_system_ignores_case_if_another_case_is_the_same_file():
    file, other = Path("config/config.yaml"), Path("config/CONFIG.YAML")
    if other.exists():
        assert configuration.ignores_case(file)
        return
    assert not configuration.ignores_case(file)
    other.write_text("another")
    assert not configuration.ignores_case(file)
    other.unlink()
    os.link(file, other)  # what such a system shows
    assert configuration.ignores_case(file)


def test_no_two_rules_write_one_file():
    """Of all names that a figure may have, those of other tables of its paper are refused."""
    files = Workplan.read(Path("config"), {}).outputs()
    tables = {Path(file).stem for file in files if Path(file).match("results/example/*.csv")}
    for name in sorted(tables - {*read_yaml(STUDY)["figures"]}):
        before = STUDY.read_text()
        rename("moment_over_heave", name)
        with pytest.raises(
            InputError, match=f"figures.{name}: its table {name}.csv would have the name of the table"
        ):
            Workplan.read(Path("config"), {})
        STUDY.write_text(before)


@pytest.mark.parametrize("path", ["riser[0].length", "riser[0].mass", "top.rotation", "water.density"])
def test_a_schematic_is_drawn_anew_when_a_value_becomes_calibrated(path):
    """Its labels mark values that are fitted to a published value."""
    scene = read_yaml(Path("config/scenes/riser.yaml"))
    here = scene
    for step in path.replace("[0]", ".0").split("."):
        here = here[int(step) if step.isdigit() else step]
    schematic = "\nschematics:\n  sketch:\n    caption: the riser\n    scene: scenes/riser.yaml\n"
    plain, text = str(here).replace("'", ""), STUDY.read_text()
    digests = set()
    for value in (f"{{derived: {plain}}}", f"{{calibrated: {plain}, to: example/N1}}"):
        STUDY.write_text(f'{text}{schematic}    set: {{"{path}": {value}}}\n')
        digests.add(Workplan.read(Path("config"), {}).figure_digest("example", "sketch"))
    assert len(digests) == 2
