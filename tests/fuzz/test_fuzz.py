"""Hostile input ends with 0, 2 or 3, one message and no file left: a share of `python tests/fuzz/run.py`."""

import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from judge import faults_of
from run import FULL, main, through_processes
from spoil import places

from riserstudy import load_scene
from riserstudy.errors import InputError

SURGE = Path(__file__).parents[2] / "config/scenes/bench/s2.yaml"
SHARE = {"scene": 50, "study": 10, "table": 20, "command": 15}


@pytest.mark.long
@pytest.mark.parametrize("kind", SHARE)
def test_a_share_of_hostile_input_is_met(kind):
    faults, codes = faults_of(kind, range(SHARE[kind]))
    assert faults == {}
    assert codes[2] > 0


@pytest.mark.slow
def test_all_hostile_input_is_met():
    assert main(FULL, 0) == 0
    assert through_processes(30, 0) == 0


def paths(tree, prefix=""):
    """Every dotted path of a tree."""
    pairs = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in pairs:
        path = f"{prefix}[{key}]" if isinstance(key, int) else f"{prefix}.{key}".lstrip(".")
        yield path
        if isinstance(value, dict | list):
            yield from paths(value, path)


anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.dates(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=5,
)
quantities = st.builds(
    "{!r}{}{}".format,
    st.floats() | st.integers(),
    st.sampled_from(["", " "]),
    st.sampled_from(["m", "N", "kN*m/deg", "%", "s", "kg/m"]) | st.text(max_size=5),
)
PATHS = sorted(paths(load_scene(SURGE).tree))


@given(path=st.sampled_from(PATHS) | st.text(max_size=20), value=anything | quantities)
def test_any_value_anywhere_is_taken_or_refused(path, value):
    try:
        tree = load_scene(SURGE, **{path: value}).resolved().model_dump()
        said = ""
    except InputError as error:
        tree, said = {}, str(error)
    assert "\n" not in said
    assert len(said) < 2000
    numbers = [at[key] for at, key in places(tree) if isinstance(at[key], float)]
    assert all(map(math.isfinite, numbers))
