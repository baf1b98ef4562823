"""Liu et al. 2020 by the engine and by the methods beside it."""

from pathlib import Path

import numpy as np
import pytest

from chapters.liu2020.derived.statics import pushed_back
from chapters.liu2020.second_methods import Beamlike, by_collocation, by_hermite_elements
from riserstudy import load_scene, simulate
from riserstudy.model.mesh import even
from riserstudy.simulation.run import single

LENGTH = 533.0


def beam(tension, speed, stiffness=2.2e7, weight=0.0):
    return Beamlike(
        LENGTH, stiffness, tension, weight, 200.0, np.array([0.0, LENGTH]), np.array([speed, speed])
    )


@pytest.mark.parametrize("solve", [by_hermite_elements, by_collocation])
def test_methods_beside_the_engine_agree_with_a_tensioned_beam_under_uniform_load(solve):
    tension, speed = 5e5, 0.8
    s = np.linspace(0.0, LENGTH, 11)
    load, k = 200.0 * speed**2, np.sqrt(tension / 2.2e7)
    bent = 1.0 - np.cosh(k * (s - 0.5 * LENGTH)) / np.cosh(0.5 * k * LENGTH)
    exact = load * (0.5 * s * (LENGTH - s) / tension - bent / (tension * k**2))
    np.testing.assert_allclose(solve(beam(tension, speed), s), exact, atol=2e-6 * exact.max())


def test_methods_beside_the_engine_agree_where_tension_varies():
    heavy = beam(9e5, 1.0, weight=1.1e3)
    s = np.linspace(0.0, LENGTH, 41)
    one, other = by_hermite_elements(heavy, s), by_collocation(heavy, s)
    np.testing.assert_allclose(one, other, atol=1e-5 * other.max())


def test_a_spring_at_the_lower_end_turns_it_as_its_moment_asks():
    """A riser so stiff that tension hardly counts, below on a spring without limit: clamped and pinned."""
    s = np.linspace(0.0, LENGTH, 201)
    stiff = beam(1.0, 0.8, stiffness=1e12)._replace(spring=1e16)
    load, x = 200.0 * 0.8**2, s / LENGTH
    exact = load * LENGTH**4 / 1e12 / 48.0 * (3.0 * x**2 - 5.0 * x**3 + 2.0 * x**4)
    # 1e16 N m/rad is no clamp by four stiffnesses of the beam over its length, 1e-6 of it
    for solve in (by_hermite_elements, by_collocation):
        np.testing.assert_allclose(solve(stiff, s), exact, atol=2e-5 * exact.max())


def test_methods_beside_the_engine_agree_on_a_spring_at_the_lower_end():
    sprung = beam(8.5e5, 1.0, weight=1.1e3)._replace(spring=1.547e6)
    s = np.linspace(0.0, LENGTH, 41)
    one, other = by_hermite_elements(sprung, s), by_collocation(sprung, s)
    np.testing.assert_allclose(one, other, atol=1e-5 * other.max())
    assert not np.allclose(one, by_hermite_elements(sprung._replace(spring=0.0), s), rtol=1e-4)


SYSTEM = Path(__file__).parents[2] / "config/scenes/liu2020/system.yaml"
SHORT = {"duration": "30 s", "output": {"interval": "0.25 s"}, "mesh": {"elements": 40}, "step": "0.125 s"}
ROLLING = {"amplitude": "4 deg", "period": "10 s", "ramp": "10 s"}


def at(scene, **changes):
    return simulate(load_scene(scene, **{"analysis": SHORT} | changes))


def test_roll_out_of_the_plane_is_pitch_in_the_plane():
    """The chapter simulates roll as pitch; the cylinders are turned with the motion."""
    pitch = at(SYSTEM, **{"platform.pitch": ROLLING})
    roll = at(SYSTEM, **{"platform.roll": ROLLING, "top.tensioners.arrangement.first_bearing": "90 deg"})
    largest = float(abs(pitch["x"]).max())
    # roll about +x takes the deck towards -y, pitch about +y towards +x
    assert float(abs(roll["y"] + pitch["x"]).max()) < 1e-6 * largest
    assert float(abs(roll["x"]).max()) < 1e-6 * largest


def test_the_platform_drags_the_ring_along_less_when_it_surges_than_the_riser_on_it():
    surge = {"platform.surge": {"amplitude": "2 m", "period": "15 s", "ramp": "15 s"}}
    with_tensioners = at(SYSTEM, **surge)
    ring = with_tensioners["x"].sel(s=533.0, method="nearest")
    assert float(abs(ring).max()) < 2.0
    assert float(abs(with_tensioners["x"].isel(s=-1)).max()) == pytest.approx(2.0, rel=0.02)


def test_one_failed_cylinder_pulls_the_ring_to_the_side():
    run = at(SYSTEM, analysis={"mesh": {"elements": 40}}, **{"top.tensioners.failed": [0]})
    force = run["tensioner_force"].values
    assert force[0] == 0.0
    assert (force[1:] > 3e5).all()
    assert float(run["x"].sel(s=533.0, method="nearest")) < 0.0


def once(step=0.125, **changes):
    """One run of the system by ``step`` (s), Newton's iteration carried on to its end."""
    tight = {"analysis": SHORT | {"newton_tolerance": 1e-12}}
    scene = load_scene(SYSTEM, **(tight | changes)).resolved()
    return single(scene, even(scene, 40), step)


def test_the_whole_system_moves_in_space_as_in_the_plane():
    shift = {"amplitude": "2 m", "period": "12 s", "ramp": "12 s"}
    moving = {"platform.pitch": ROLLING, "platform.surge": shift, "platform.heave": shift}
    one = once(**moving)
    other = once(**moving, **{"platform.sway": {"amplitude": "0 m", "period": "12 s"}})
    assert [run.facts["directions"] for run in (one, other)] == [2, 3]
    flat, space = one.arrays, other.arrays
    peak = np.abs(flat["x"]).max()
    assert peak > 1.5
    for name in ("x", "z", "stroke", "tensioner_stroke"):
        assert np.abs(space[name] - flat[name]).max() < 1e-9 * peak
    assert np.abs(space["y"]).max() < 1e-9 * peak
    for name in ("effective_tension", "bending_moment", "tensioner_force", "ufj_angle", "lfj_angle"):
        size = np.abs(flat[name])
        expected = flat[name] if name in ("effective_tension", "tensioner_force") else size
        assert np.abs(space[name] - expected).max() < 1e-9 * size.max()


def test_the_gas_law_runs_in_space_with_a_cylinder_failed():
    found = once(0.0625, **{"platform.roll": ROLLING, "top.tensioners.failed": [1]})
    assert found.facts["directions"] == 3
    force = found.arrays["tensioner_force"]
    assert (force[:, 1] == 0.0).all()
    left = np.delete(force, 1, axis=1)
    assert left.min() > 3e5
    # those at other bearings pull differently, and change while the platform rolls
    assert (left.max(axis=1) - left.min(axis=1)).min() > 500.0
    assert np.ptp(left, axis=0).max() > 2000.0
    x, y = (found.arrays[name + "_static"][-2] for name in "xy")  # of the ring
    assert x * np.cos(np.radians(60.0)) + y * np.sin(np.radians(60.0)) < -1e-3
    assert found.facts["audit"]["unexplained_share"] < 1e-4


def test_the_horizontal_force_balances_a_ring_held_aside():
    """Six cylinders of 24 m and a ring 0.24 m aside: one per cent of their pull."""
    scene = load_scene(SYSTEM).resolved()
    rig = scene.top.tensioners.replaced(
        arrangement=scene.top.tensioners.arrangement.replaced(ring_radius=1e-9, deck_radius=1e-9)
    )
    scene = scene.replaced(top=scene.top.replaced(tensioners=rig))
    force = pushed_back(scene, np.full(6, 1e5), np.array([0.24, 0.24]), np.array([500.0, 533.0]))
    assert force == pytest.approx(6e5 * 0.24 / np.hypot(24.0, 0.24), rel=1e-6)
