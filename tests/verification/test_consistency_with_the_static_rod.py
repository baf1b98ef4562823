"""S1 and S1c against the extensible Kirchhoff rod solved by collocation."""

from functools import cache

import numpy as np
import pytest
import reference as ref
from engine import dataset, off, slopes

HELD = {"top": {"x": "held", "z": "held", "elevation": "533.09169 m", "rotation": "free"}}
CASES = {"S1": ({}, None), "S1c": (HELD, 533.09169)}
ELEMENTS = np.array([32, 48, 64, 96, 128])
STATIONS = np.unique(np.concatenate([np.linspace(0.0, 533.0, n + 1) for n in (*ELEMENTS, 200)]))


@cache
def rod(height):
    """The rod at all stations that any test compares; a few seconds."""
    return ref.static_current(STATIONS, top_height=height, tolerance=1e-10)


def errors(case, elements):
    values, height = CASES[case]
    found = dataset("s1", elements, **values)
    at = np.searchsorted(STATIONS, found["s"].values - 1e-6)
    best = rod(height)
    exact = best._replace(x=best.x[at], moment=best.moment[at], tension=best.tension[at])
    return (
        off(found["x"], exact.x),
        off(found["bending_moment"], exact.moment),
        off(found["effective_tension"], exact.tension),
    )


@pytest.mark.long
@pytest.mark.parametrize("case", CASES)
def test_the_scene_s_mesh_gives_the_rod_to_a_ten_thousandth(case):
    x, moment, tension = errors(case, None)
    assert x < 1e-4
    assert moment < 1e-4
    assert tension < 1e-4


@pytest.mark.long
@pytest.mark.parametrize("case", CASES)
def test_displacement_and_moment_converge_with_at_least_second_order(case):
    found = np.array([errors(case, int(n)) for n in ELEMENTS])
    for k in range(2):
        # fourth order at first; what is left of second order shows in S1's displacement below 1e-6
        assert slopes(1.0 / ELEMENTS, found[:, k]).min() > 1.9
    assert found[0, 0] < 5e-4
    assert found[0, 1] < 5e-3


def test_an_accuracy_asked_for_is_reached():
    found = dataset("s1", analysis={"accuracy": "0.1 %"})
    exact = ref.static_current(found["s"].values)
    assert off(found["x"], exact.x) < 1e-3
    assert off(found["bending_moment"], exact.moment) < 1e-3


def test_the_support_force_at_the_top_is_the_force_that_was_given():
    top = float(dataset("s1")["effective_tension"][-1])
    # the component along the last segment, whose direction is the pipe's to 1e-3 rad
    assert top == pytest.approx(rod(None).tension[-1], rel=1e-6)
