"""Dotted paths of a scene: one way to read, write, list and compare them."""

import copy
from functools import partial
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from riserstudy.errors import InputError
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.scene import paths
from riserstudy.scene.fields import in_si
from riserstudy.scene.load import read_scene
from riserstudy.study.sweep import as_study

SCENES = sorted((Path(__file__).parents[2] / "config/scenes").rglob("*.yaml"))
NAMES = st.from_regex(r"[a-z_]\w{0,8}", fullmatch=True)
TREES = st.recursive(
    st.integers() | st.text(max_size=5),
    lambda inner: (
        st.dictionaries(NAMES, inner, min_size=1, max_size=4) | st.lists(inner, min_size=1, max_size=3)
    ),
    max_leaves=20,
)


@pytest.mark.long
@given(st.dictionaries(NAMES, TREES, min_size=1, max_size=5))
def test_every_leaf_is_read_at_its_path_and_can_be_written_there(tree):
    written = {}
    for path, value in paths.leaves(tree):
        assert paths.value_at(tree, path) == value
        changed = copy.deepcopy(tree)
        paths.put(changed, path, "new")
        assert [p for p, v in paths.leaves(changed) if v != paths.value_at(tree, p)] in ([path], [])
        assert paths.value_at(changed, path) == "new"
        written[path] = value
    assert len(written) == len(list(paths.leaves(tree)))


@given(st.dictionaries(NAMES, TREES, min_size=1, max_size=5))
def test_a_path_lies_within_all_that_is_above_it_and_within_nothing_else(tree):
    every = [path for path, _ in paths.leaves(tree)]
    places = {place for path in every for place in paths.and_above(path)}
    for path in every:
        above = set(paths.and_above(path))
        assert {place for place in places if paths.within(path, place)} == above
        assert paths.matches(path, path)


@pytest.mark.parametrize("file", SCENES, ids=lambda file: file.stem)
def test_paths_of_every_scene_are_whole(file):
    tree = read_yaml(file)
    for path, value in paths.leaves(tree):
        assert paths.value_at(tree, path) == value
        bare = paths.without_indices(path)
        assert "[" not in bare
        assert paths.matches(path, path.replace("[0]", "[*]"))


def test_a_length_more_or_a_name_less_is_another_path():
    assert not paths.within("riser[10].length", "riser[1]")
    assert not paths.within("topside", "top")
    assert not paths.matches("riser[0].mass", "riser[*]")
    assert paths.as_name("riser[0].drag.coefficient") == "riser_0_drag_coefficient"


NO_PATHS = ["", "a..b", "a[x]", "[0]", "a[0", "0a", "a b", "a[00]", "a[01]"]


@pytest.mark.parametrize("path", NO_PATHS)
def test_what_is_no_path_is_refused_and_nothing_stands_there(path):
    with pytest.raises(ValueError, match=r".*"):
        paths.steps(path)
    assert not paths.is_path(path)
    assert paths.value_at({"a": {"b": 1}, "": 2}, path) is None
    assert in_si(path, "1 m") == (None, None)


@pytest.mark.parametrize("values", [[1.0, 2.0], ["1 m", "2 m"], ["a", "b"]], ids=str)
@pytest.mark.parametrize("path", [*NO_PATHS, "riser[x].mass", "riser[0].mass.x"])
def test_an_axis_that_is_no_path_is_refused_by_a_message_whatever_its_values(path, values):
    study = partial(as_study, read_scene(SCENES[0]), {path: values}, None, None)
    with pytest.raises(InputError):
        list(study().plan)


def test_nothing_is_put_where_nothing_leads():
    tree = {"riser": [{"mass": 1}], "top": "held"}
    for path in ("riser[1].mass", "top.x", "riser.mass"):
        before = copy.deepcopy(tree)
        with pytest.raises(LookupError):
            paths.put(tree, path, 2)
        assert tree == before
    paths.put(tree, "riser[0].mass", None)
    assert tree == {"riser": [{}], "top": "held"}


@pytest.mark.parametrize("file", SCENES, ids=lambda file: file.stem)
def test_a_replaced_value_has_no_origin_of_what_it_replaces(file):
    """Each key and list of a scene with assumptions below it, written anew as plain values."""
    scene = read_scene(file)
    places = {place for path in scene.origins for place in paths.and_above(path)}
    for place in sorted(places):
        anew = scene.with_values({place: copy.deepcopy(paths.value_at(scene.tree, place))}, "set")
        assert not [path for path in anew.origins if paths.within(path, place)]
        assert {path for path in scene.origins if not paths.within(path, place)} == set(anew.origins)
