"""hangoff_ref and its variants: steady state by three independent ways, and the two integrators."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from reference_towed import Towed, steady

from riserstudy import load_scene, simulate, solve
from riserstudy.simulation.refine import run

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
    "analysis.mesh": {"elements": 200, "layers": {"top": "7 m", "bottom": "14 m"}},
    "analysis.step": "0.5 s",
}
CASES = {
    "hangoff_ref": Towed(),
    "hangoff_ref_120t": Towed(end_weight=1177200.0),
    "hangoff_ref_xdrag": Towed(horizontal=True),
}


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
    pairs = {
        "astern": (astern(run), -known["x"][-1]),
        "largest moment": (float(abs(run["bending_moment"]).max()), abs(known["moment"]).max()),
        "moment at the joint": (float(run["bending_moment"][-1]), known["moment"][0]),
        "top tension": (float(run["effective_tension"][-1]), known["tension"][0]),
    }
    for what, (found, wanted) in pairs.items():
        assert found == pytest.approx(wanted, rel=1e-3), what


def test_the_shape_is_that_of_the_boundary_value_problem_everywhere():
    known, run = reference("hangoff_ref"), statics("hangoff_ref")
    below = float(run["s"][-1]) - run["s"].values
    x = np.interp(below, known["s"], known["x"])
    assert np.abs(run["x"].values - run["x"].values[-1] - x).max() < 1e-3 * abs(known["x"][-1])


def test_segments_of_the_paper_miss_little_of_the_jump_and_the_kinks_that_lie_within_them():
    """36 m segments: C_D jumps in the middle of one, the current has its kinks in two others."""
    even = {"analysis": {"mesh": {"elements": 50}}}
    coarse = simulate(load_scene(SCENES / "hangoff_ref.yaml", **(FROM_THE_PLATFORM | even)))
    assert astern(coarse) == pytest.approx(-reference("hangoff_ref")["x"][-1], rel=2e-4)


def test_a_current_integrated_inside_such_segments_would_be_no_nearer():
    """The engine samples it at nodes. Nodes that sample what makes the load its integral differ by 5e-5."""
    elements = 50
    even = {"analysis": {"mesh": {"elements": elements}}}
    sampled, integrated = (
        astern(simulate(load_scene(SCENES / "hangoff_ref.yaml", **(FROM_THE_PLATFORM | even | sets))))
        for sets in ({}, {"current.profile": as_integrated(elements)})
    )
    wanted = -reference("hangoff_ref")["x"][-1]
    assert 3e-5 < abs(sampled / integrated - 1.0) < 1e-4
    assert abs(integrated / wanted - 1.0) < 2e-4
    assert abs(sampled / wanted - 1.0) < abs(integrated / wanted - 1.0)


def as_integrated(elements, points=400):
    """Current whose values at the nodes, spread by the engine's shares, load them with the integral.

    That is, of C_D u |u| against the hat functions of the nodes of an upright riser.
    """
    size = 1800.0 / elements
    share = (np.arange(points) + 0.5) / points
    load, spread = np.zeros(elements + 1), np.zeros((elements + 1, elements + 1))
    for e in range(elements):
        depth = size * (e + share)
        speed = -1.0 - np.interp(depth, [100.0, 300.0], [1.0, 0.0])
        drag = np.where(depth < 150.0, 1.2, 0.7)
        for own, other, hat in ((e, e + 1, 1.0 - share), (e + 1, e, share)):
            load[own] += size * np.mean(drag * np.abs(speed) * speed * hat)
            coefficient = 2.0 * size * np.mean(drag * hat)
            spread[own, own] += coefficient * 5.0 / 12.0
            spread[own, other] += coefficient / 12.0
    speeds = -np.sqrt(-np.linalg.solve(spread, load))
    return [{"elevation": f"{-size * i} m", "speed": f"{speeds[i]} m/s"} for i in range(elements, -1, -1)]


SIX_KNOTS = {
    "current.profile": {"shape": "uniform", "surface_speed": "-6 knot"},
    "water.surface": "0 m",
    "water.seabed": "-3000 m",
    "riser[0].length": "1500 m",
    "bottom.body.mass": "20 t",
    "bottom.body.submerged_weight": "196.2 kN",
}


@cache
def lifted():
    return simulate(load_scene(SCENES / "hangoff_ref.yaml", **(FROM_THE_PLATFORM | SIX_KNOTS)))


def test_the_coefficient_is_that_of_the_depth_where_a_lifted_riser_is():
    """In 6 kn the lower end of 1500 m with 20 t rises by 196 m, and trails farther by a thousandth."""
    case = Towed(length=1500.0, end_weight=196200.0, current=0.0, platform=6.0 * 1852.0 / 3600.0)
    by_depth, by_length = (steady(replace(case, step_by_depth=x), 1e-6) for x in (True, False))
    assert by_depth["z"][-1] < 1310.0
    assert astern(lifted()) == pytest.approx(-by_depth["x"][-1], rel=2e-4)
    assert by_length["x"][-1] / by_depth["x"][-1] < 1.0 - 1e-3


def test_statics_end_as_fast_in_strong_flow_at_low_tension(monkeypatch):
    """The drag's derivative by the pipe's direction is in the tangent: the last corrections shrink by 100."""
    corrections, newton = [], solve.statics._newton

    def noted(*args):
        result = newton(*args)
        corrections.append(result[2])
        return result

    monkeypatch.setattr(solve.statics, "_newton", noted)
    even = {"analysis": {"mesh": {"elements": 120}}}
    scene = load_scene(SCENES / "hangoff_ref.yaml", **(FROM_THE_PLATFORM | SIX_KNOTS | even)).resolved()
    run(scene, estimated=False)
    assert corrections[-1] < 0.01 * corrections[-2] < 1e-4 * corrections[-3]


@pytest.mark.long
@pytest.mark.parametrize("name", [*CASES, "hangoff_ref_heave"])
def test_both_integrators_agree(name):
    """130 s of the transient: 0.2 % of displacement, 1 % of moment."""
    short = {"analysis.duration": "130 s", "analysis.output.interval": "10 s"}
    mesh = {"analysis.accuracy": None, "analysis.mesh": {"elements": 100}}
    implicit = {"analysis.step": "0.05 s"}
    explicit = {"analysis.step": "0.003 s", "analysis.method": "explicit"}
    one, two = (
        simulate(load_scene(SCENES / f"{name}.yaml", **(short | mesh | way))) for way in (implicit, explicit)
    )
    away = one["x"] - one["x"].isel(s=-1)
    apart = abs(away - (two["x"] - two["x"].isel(s=-1))).max()
    assert float(apart) < 0.002 * float(abs(away).max())
    largest = [abs(run["bending_moment"].isel(time=slice(2, None))).max("s") for run in (one, two)]
    np.testing.assert_allclose(largest[1], largest[0], rtol=0.01)
    difference = abs(one["bending_moment"] - two["bending_moment"]).isel(time=-1).max()
    assert float(difference) < 0.01 * float(largest[0][-1])
