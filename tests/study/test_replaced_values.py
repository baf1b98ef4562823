"""Each of several values that are set together is in the scene, or they are refused: over seeded rigs."""

import json
import random

import pytest
import xarray as xr
from random_rigs import moving, written
from ruamel.yaml import YAML

from riserstudy.dataset.provenance import scene_file_of
from riserstudy.errors import InputError
from riserstudy.inputs.validate import check
from riserstudy.scene.load import SceneFile
from riserstudy.scene.paths import and_above, leaves, value_at
from riserstudy.study.grid import Grid
from riserstudy.study.read import read_studies
from riserstudy.study.study_model import StudyModel
from riserstudy.study.sweep import as_study

LIMIT = {"output": "lfj_angle", "largest": "3 deg", "mode": "drilling"}


def drawn(seed, spatial):
    """A rig, and values of some paths of it and of paths above them, in any order."""
    draw = random.Random(f"{seed} {spatial}")
    tree = written(moving(seed, spatial=spatial)) | {"limits": [LIMIT]}
    every = [path for path, _ in leaves(tree) if path != "title"]
    some = [path for leaf in draw.sample(every, 2) for path in (leaf, draw.choice([*and_above(leaf)]))]
    paths = list(dict.fromkeys(draw.sample(some, len(some))))
    return tree, {path: value_at(tree, path) for path in paths}, draw


def marked(sets, draw):
    """The values, of which a number or a text has a mark of its own."""
    return {
        path: f"mark {draw.random()}" if isinstance(value, int | float | str) else value
        for path, value in sets.items()
    }


def one_by_one(file, sets):
    """The scene with values that are set one after another."""
    for path, value in sets.items():
        file = file.with_values({path: value}, "one")
    return file


def all_there(tree, sets):
    """Whether a tree has each value, apart from what others changed below it."""
    return all(value_at(tree, path) == value for path, value in sets.items() if isinstance(value, str))


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(12))
def test_of_values_that_are_set_together_none_is_lost(seed, spatial):
    tree, sets, draw = drawn(seed, spatial)
    sets, file = marked(sets, draw), SceneFile("rig.yaml", tree)
    there = all_there(one_by_one(file, sets).tree, sets)
    fields = {"scene": "rig.yaml", "caption": "a rig", "axes": {}}
    ways = (fields | {"set": sets}, fields | {"axes": {"kind": {"one": {}, "other": sets}}})
    for way in ways:
        if there:
            check(StudyModel, way, "study.yaml")
            continue
        with pytest.raises(InputError, match="which is set after it, replaces it"):
            check(StudyModel, way, "study.yaml")
    if there:
        assert file.with_values(sets, "sets").tree == one_by_one(file, sets).tree
        return
    with pytest.raises(InputError, match="replaces it"):
        as_study(file, {"kind": {"one": {}, "other": sets}}, None)
    with pytest.raises(InputError, match="replaces it"):
        file.with_values(sets, "sets")


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(12))
def test_of_values_of_axes_the_last_is_in_the_scene(seed, spatial):
    tree, sets, draw = drawn(seed, spatial)
    sets, file = marked(sets, draw), SceneFile("rig.yaml", tree)
    axes = [[{}, {path: value}] for path, value in sets.items()]
    index = tuple(draw.randrange(2) for _ in axes)
    some = {path: value for (path, value), k in zip(sets.items(), index, strict=True) if k}
    expected = one_by_one(file, some)
    assert Grid(file, axes, "grid").file(index).tree == expected.tree
    dataset = xr.Dataset(attrs={"scene": json.dumps(tree), "tables": "{}"})
    for number, (_, other) in enumerate(axes):
        about = {"sets": json.dumps({"no": {}, "yes": other})}
        dataset[f"axis{number}"] = (f"axis{number}", ["no", "yes"], about)
    chosen = {f"axis{number}": k for number, k in enumerate(index)}
    assert scene_file_of(dataset, chosen).tree == expected.tree


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(2))
def test_of_values_of_the_command_line_none_is_lost(seed, spatial, commands, tmp_path):
    tree = written(moving(seed, spatial=spatial)) | {"limits": [LIMIT]}
    scene = tmp_path / "rig.yaml"
    with scene.open("w") as file:
        YAML().dump(tree, file)
    surge = "{amplitude: 1 m, period: 9 s, ramp: 9 s}"
    for whole in (surge, "null"):
        words = ("--set", "platform.surge.amplitude=5 m", "--set", f"platform.surge={whole}")
        code, out, err = commands("effects", scene, *words)
        assert (code, out) == (2, "")
        assert "--set: platform.surge.amplitude" in err
    words = ("--set", f"platform.surge={surge}", "--set", "platform.surge.amplitude=5 m")
    assert commands("effects", scene, *words)[0] == 0


def test_limits_of_a_study_do_not_replace_an_allowable_that_it_sets():
    fields = {"scene": "rig.yaml", "caption": "a rig", "axes": {}, "limits": [LIMIT]}
    for path in ("limits", "limits[0].largest"):
        with pytest.raises(InputError, match="also sets limits"):
            check(StudyModel, fields | {"set": {path: "2 deg"}}, "study.yaml")


@pytest.mark.parametrize("place", ["scene", "study"])
@pytest.mark.parametrize("seed", range(3))
def test_a_grid_has_a_plot_of_its_limits_wherever_they_are_given(seed, place, tmp_path):
    tree = written(moving(seed, spatial=bool(seed % 2)))
    study = {"scene": "rig.yaml", "caption": "a rig"}
    study["axes"] = {"mass": {"path": "riser[0].mass", "unit": "kg/m", "values": [500, 800]}}
    (tree if place == "scene" else study)["limits"] = [LIMIT]
    (tmp_path / "studies").mkdir()
    for name, content in (("rig", tree), ("studies/mine", {"paper": "mine", "studies": {"grid": study}})):
        with (tmp_path / f"{name}.yaml").open("w") as file:
            YAML().dump(content, file)
    assert "utilisation" in [figure.plot for figure in read_studies(tmp_path, "mine").figures.values()]
