"""What planning holds against each other: scenes against what papers print, axes against scenes."""

import os
import random
import re

import pytest
from planning import dry_run

from riserstudy.errors import InputError
from riserstudy.jobs.workplan import Workplan
from riserstudy.scene.load import read_scene
from riserstudy.scene.origin import plain_values
from riserstudy.study.new import new_study

SCENE = "config/scenes/riser.yaml"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder of one's own, whose scene is one of a paper that prints all its plain values."""
    new_study(tmp_path / "own")
    monkeypatch.chdir(tmp_path / "own")
    scene = tmp_path / "own" / SCENE
    scene.write_text(f"paper: example\n{scene.read_text()}")
    file = read_scene(scene)
    lines = [
        f"  - {{what: a value, value: {value!r}, where: Table {k}, at: '{path}'}}"
        for k, (path, value) in enumerate(plain_values(file.tree, file.origins))
    ]
    published = tmp_path / "own/config/published/example.yaml"
    published.write_text("\n".join([published.read_text(), "inputs:", *lines, ""]))
    return tmp_path / "own"


def edit(path, old, new):
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new, 1))


def test_a_scene_of_printed_values_is_planned(folder):
    assert Workplan.read(folder / "config", {}).warnings == []


@pytest.mark.parametrize("seed", range(6))
def test_a_plain_value_that_the_paper_does_not_print_is_refused(folder, seed):
    """Any number of the scene, changed a little."""
    text = (folder / SCENE).read_text()
    unit = r"(kg/m\^3|kN\*m/deg|kN\*s/m|kg/m|N/m|in|m|s|deg)"
    numbers = re.compile(rf"\b(\d+\.?\d*) {unit}(?=[\s,}}])").finditer(text, text.index("water:"))
    # where the riser ends a station stands, which would be refused before
    one = random.Random(seed).choice([m for m in numbers if m[1] not in ("0", "1500")])
    wrong = f"{float(one[1]) * 0.9924:.6g} {one[2]}"
    (folder / SCENE).write_text(text[: one.start()] + wrong + text[one.end() :])
    with pytest.raises(InputError, match=re.escape(f"{wrong} has no origin, which marks it as published")):
        Workplan.read(folder / "config", {})
    origin = f'{{chosen: {wrong}, because: "to see"}}'
    (folder / SCENE).write_text(text[: one.start()] + origin + text[one.end() :])
    Workplan.read(folder / "config", {})


def test_a_scene_of_no_paper_and_a_paper_without_a_list_are_not_held_against_any(folder):
    edit(folder / SCENE, "mass: 900 kg/m", "mass: 901 kg/m")
    text = (folder / SCENE).read_text()
    edit(folder / SCENE, "paper: example\n", "")
    Workplan.read(folder / "config", {})
    (folder / SCENE).write_text(text)
    published = folder / "config/published/example.yaml"
    published.write_text(published.read_text().split("inputs:")[0])
    Workplan.read(folder / "config", {})


def test_a_slip_of_a_unit_in_a_study_file_is_warned_of_when_it_is_planned(folder):
    edit(folder / "config/studies/example.yaml", "unit: m\n", "unit: km\n")
    (warning,) = Workplan.read(folder / "config", {}).warnings
    assert "times the scene's" in warning
    status, said = dry_run(folder, os.environ)
    assert status == 0
    assert f"riserstudy: warning: {warning}" in said
