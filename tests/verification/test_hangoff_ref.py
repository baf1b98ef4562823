"""hangoff_ref and its variants: steady state by three independent ways, and the two integrators."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from reference_towed import Towed, steady

from riserstudy import load_scene, simulate

SCENES = Path(__file__).parents[2] / "config" / "scenes" / "mao_hangoff"
#: seen from the platform, whose water flows at current less platform speed
FROM_THE_PLATFORM = {
    "platform": None,
    "top.x": "held",
    "top.z": "held",
    "current.profile": [
        {"elevation": "-300 m", "speed": "-1 m/s"},
        {"elevation": "-100 m", "speed": "-2 m/s"},
    ],
    "current.ramp": None,
    "analysis": {"accuracy": "0.2 %"},
}
LONG = {
    "analysis.duration": "2000 s",
    "analysis.output": {"start": "2000 s", "interval": "1 s"},
    "analysis.accuracy": None,
    "analysis.mesh": {"elements": 400},
    "analysis.step": "0.5 s",
}
CASES = {"hangoff_ref": Towed(), "hangoff_ref_120t": Towed(end_weight=1177200.0)}


@cache
def reference(name):
    return steady(CASES[name], 1e-6)


@cache
def statics(name):
    return simulate(load_scene(SCENES / f"{name}.yaml", **FROM_THE_PLATFORM))


@cache
def transient(name):
    return simulate(load_scene(SCENES / f"{name}.yaml", **LONG)).isel(time=-1)


def astern(run):
    return float(run["x"][-1] - run["x"][0])


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("way", [statics, transient])
def test_the_steady_state_is_that_of_the_boundary_value_problem(name, way):
    known, run = reference(name), way(name)
    assert astern(run) == pytest.approx(-known["x"][-1], rel=1e-3)
    assert abs(run["bending_moment"]).max() == pytest.approx(abs(known["moment"]).max(), rel=3e-3)
    tension = float(run["effective_tension"][-1])
    assert tension == pytest.approx(known["tension"][0], rel=1e-3)


def test_the_shape_is_that_of_the_boundary_value_problem_everywhere():
    known, run = reference("hangoff_ref"), statics("hangoff_ref")
    below = float(run["s"][-1]) - run["s"].values
    x = np.interp(below, known["s"], known["x"])
    assert np.abs(run["x"].values - run["x"].values[-1] - x).max() < 1e-3 * abs(known["x"][-1])


def test_a_drag_coefficient_that_changes_at_a_length_instead_of_a_depth_makes_no_difference():
    """The upper 150 m of a leaning riser end half a metre above 150 m of depth."""
    by_depth = steady(Towed(step_by_depth=True), 1e-6)
    assert by_depth["x"][-1] == pytest.approx(reference("hangoff_ref")["x"][-1], rel=1e-4)


def test_horizontal_drag_instead_of_normal_drag_makes_little_difference():
    horizontal = steady(Towed(horizontal=True), 1e-6)
    known = reference("hangoff_ref")
    assert horizontal["x"][-1] == pytest.approx(known["x"][-1], rel=1e-3)
    assert horizontal["tension"][0] == pytest.approx(known["tension"][0], rel=1e-2)


@pytest.mark.parametrize("name", [*CASES, "hangoff_ref_heave"])
def test_both_integrators_agree(name):
    """130 s of the transient: 0.2 % of displacement, 1 % of moment."""
    short = {"analysis.duration": "130 s", "analysis.output.interval": "10 s"}
    mesh = {"analysis.accuracy": None, "analysis.mesh": {"elements": 300}}
    implicit = {"analysis.step": "0.05 s"}
    explicit = {"analysis.step": "0.001 s", "analysis.method": "explicit"}
    one, two = (
        simulate(load_scene(SCENES / f"{name}.yaml", **(short | mesh | way)))
        for way in (implicit, explicit)
    )
    away = one["x"] - one["x"].isel(s=-1)
    apart = abs(away - (two["x"] - two["x"].isel(s=-1))).max()
    assert float(apart) < 0.002 * float(abs(away).max())
    largest = [abs(run["bending_moment"].isel(time=slice(2, None))).max("s") for run in (one, two)]
    np.testing.assert_allclose(largest[1], largest[0], rtol=0.01)
    difference = abs(one["bending_moment"] - two["bending_moment"]).isel(time=-1).max()
    assert float(difference) < 0.01 * float(largest[0][-1])
