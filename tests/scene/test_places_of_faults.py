"""The place that an error names is one of the file, whatever alternatives a field has."""

import copy
import re
from pathlib import Path

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.errors import InputError
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.scene.load import SceneFile

SCENES = sorted((Path(__file__).parents[2] / "config/scenes").glob("*/*.yaml"))
WRONG = (["x"], ["x", "y", "z"], [1.0], {"a": 1}, 5, "x", True, None)


def leaves(tree, path=()):
    """Paths to all values that are neither mapping nor list, and to lists."""
    if isinstance(tree, dict | list):
        items = tree.items() if isinstance(tree, dict) else enumerate(tree)
        below = [leaf for key, value in items for leaf in leaves(value, (*path, key))]
        return below + ([path] if isinstance(tree, list) else [])
    return [path]


def with_value(tree, path, value):
    changed = copy.deepcopy(tree)
    at = changed
    for step in path[:-1]:
        at = at[step]
    at[path[-1]] = value
    return changed


def assert_in_the_file(tree, draw, times):
    places, named = leaves(tree), []
    for _ in range(times):
        path = places[int(draw.integers(len(places)))]
        wrong = with_value(tree, path, WRONG[int(draw.integers(len(WRONG)))])
        try:
            SceneFile("scene.yaml", wrong).scene()
        except InputError as error:
            named.append(error.field)
    assert not [name for name in named if re.search(r"\.(str|int|float|bool|dict|list)\b", name)]
    assert len(named) > times // 4


@pytest.mark.parametrize("path", SCENES[::3], ids=lambda path: path.stem)
def test_a_wrong_value_in_a_scene_of_a_study_is_named_as_the_file_has_it(path):
    tree = read_yaml(path)
    assert_in_the_file(tree, np.random.default_rng(len(path.stem)), 20)


@pytest.mark.parametrize("seed", range(6))
def test_a_wrong_value_in_a_rig_with_welds_is_named_as_the_file_has_it(seed):
    tree = written(rig(seed))
    detail = {
        "name": "weld",
        "at": ["section 0", "section 1"],
        "face": "outside",
        "stress_concentration": 1.2,
        "safety_factor": 10,
    }
    detail |= {"curve": {"detail_class": "D", "environment": "air"}}
    tree["fatigue"] = {"angles": 8, "details": [detail]}
    assert_in_the_file(tree, np.random.default_rng(seed), 40)


@pytest.mark.parametrize("names", [["one"], ["one", "two", "three"], []])
def test_a_weld_between_other_than_two_sections_is_refused_by_their_number(names):
    tree = written(rig(0))
    detail = {
        "name": "weld",
        "at": names,
        "face": "outside",
        "stress_concentration": 1.2,
        "safety_factor": 10,
    }
    detail |= {"curve": {"detail_class": "D", "environment": "air"}}
    tree["fatigue"] = {"angles": 8, "details": [detail]}
    with pytest.raises(InputError, match=r"fatigue\.details\[0\]\.at: .*the number of items is") as told:
        SceneFile("rig.yaml", tree).scene()
    assert told.value.field == "fatigue.details[0].at"
