"""Currents that jump at one elevation: the load is that of both waters, wherever nodes are."""

import math

import numpy as np
import pytest
from engine import scene
from random_rigs import rig, written
from scipy.integrate import cumulative_trapezoid

from riserstudy.errors import InputError
from riserstudy.model.current_jump import spread
from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.run import single
from riserstudy.simulation.simulate import simulate

LENGTH, DENSITY, WIDTH = 400.0, 1025.0, 1.2


def string(points, **more):
    """A taut weightless string, pinned at both ends, in a current."""
    tree = {
        "title": "string", "water": {"density": f"{DENSITY} kg/m^3"},
        "riser": [{
            "name": "string", "length": f"{LENGTH} m", "axial_stiffness": "1e13 N",
                "submerged_weight": "0 N/m",
            "drag": {"coefficient": 1.0, "diameter": f"{WIDTH} m", "direction": "horizontal"},
        }],
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "held", "z": "free", "tension": "1e8 N"},
        "current": points if isinstance(points, dict) else {"profile": points}, "analysis": {}, **more,
    }  # fmt: skip
    return SceneFile("string.yaml", tree).resolved()


def drawn(seed, directions=False):
    """Elevations, speeds and directions of two waters, the lower one changing with elevation."""
    chance = np.random.default_rng(seed)
    level = float(chance.uniform(0.2, 0.8)) * LENGTH
    speeds = [0.1, *chance.uniform(-1.0, 1.0, 2), 0.8]
    angles = chance.uniform(-90.0, 90.0, 4) if directions else np.zeros(4)
    points = [
        {"elevation": f"{z!r} m", "speed": f"{float(v)!r} m/s"}
        | ({"direction": f"{float(a)!r} deg"} if directions else {})
        for z, v, a in zip((0.0, level, level, LENGTH), speeds, angles, strict=True)
    ]
    return level, speeds, np.radians(angles), points


def pulled_aside(level, speeds, angles):
    """Displacement (m) of the string by its load, by x and y and at places: two integrals of |u| u."""
    z = np.concatenate([np.linspace(0.0, level, 20001), np.linspace(level, LENGTH, 20001)])
    parts = np.array([f(angles) * speeds for f in (np.cos, np.sin)])
    u = np.array([
        np.concatenate([np.linspace(p[0], p[1], 20001), np.linspace(p[2], p[3], 20001)]) for p in parts
    ])  # fmt: skip
    load = 0.5 * DENSITY * WIDTH * np.linalg.norm(u, axis=0) * u / 1e8
    slope = -cumulative_trapezoid(load, z, initial=0.0)
    x = cumulative_trapezoid(slope, z, initial=0.0)
    x -= x[:, -1:] * z / LENGTH
    return lambda s: np.array([np.interp(s, z, part) for part in x])


@pytest.mark.parametrize("directions", [False, True])
def test_the_error_of_a_jump_falls_by_the_square_of_the_segments(directions):
    errors = dict.fromkeys((10, 20, 40, 80), 0.0)
    for seed in range(6):
        level, speeds, angles, points = drawn(seed, directions)
        right = pulled_aside(level, speeds, angles)
        file = string(points)
        for n in errors:
            found = single(file, even(file, n), None).arrays
            s = found["s_node"]
            is_at = np.array([found.get(f"{name}_static", 0.0 * s) for name in ("x", "y")])
            off = np.abs(is_at - right(s)).max() / np.abs(right(s)).max()
            errors[n] = max(errors[n], float(off))
    assert errors[80] < 1e-3
    assert math.log2(errors[10] / errors[80]) / 3.0 > 1.8, errors


def test_the_error_of_a_current_that_ends_in_midwater_falls_by_the_square_of_the_segments():
    errors = dict.fromkeys((10, 20, 40, 80), 0.0)
    for seed in range(6):
        level, speeds, angles, points = drawn(seed)
        right = pulled_aside(level, [0.0, 0.0, *speeds[2:]], angles)
        file = string({"profile": points[2:], "beyond": "zero"})
        for n in errors:
            found = single(file, even(file, n), None).arrays
            s = found["s_node"]
            off = np.abs(found["x_static"] - right(s)[0]).max() / np.abs(right(s)).max()
            errors[n] = max(errors[n], float(off))
    assert errors[80] < 2e-3
    assert math.log2(errors[10] / errors[80]) / 3.0 > 1.8, errors


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_air_above_the_surface_takes_no_load_from_the_water_below(seed, spatial):
    tree = written(rig(seed, spatial=spatial))
    if spatial:
        tree["current"]["heading"] = "40 deg"
    found = []
    for beyond in ("hold", "zero"):
        tree["current"]["beyond"] = beyond
        file = SceneFile("rig.yaml", tree).resolved()
        found.append(single(file, even(file, 37), None).arrays)
    for name in ("x_static", "bending_moment_static"):
        scale = np.abs(found[0][name]).max()
        assert found[1][name] == pytest.approx(found[0][name], abs=1e-6 * scale), name


def test_a_jump_of_a_riser_that_bends_is_seen_by_the_error_estimate():
    points = [
        {"elevation": f"{z} m", "speed": f"{v} m/s"}
        for z, v in ((0.0, 0.1), (371.3, 0.2), (371.3, 1.1), (540.0, 1.2))
    ]
    file = scene("s1", current={"profile": points})
    fine = single(file.resolved(), even(file.resolved(), 2000), None).arrays
    found = simulate(file.with_values({"analysis": {"accuracy": "0.1 %"}}, "test"), progress=False)
    for name, node, allowed in (("x", "x_static", 1e-3), ("bending_moment", "bending_moment_static", 5e-3)):
        right = np.interp(found["s"], fine["s_node"], np.abs(fine[node]))
        off = np.abs(np.abs(found[name].to_numpy()) - right).max() / np.abs(right).max()
        assert off < allowed, name


@pytest.mark.parametrize("seed", range(5))
def test_a_spread_jump_keeps_its_load_and_leaves_the_rest(seed):
    chance = np.random.default_rng(seed)
    z = np.array([0.0, 40.0, 40.0, 100.0])
    velocity = np.repeat(chance.uniform(-1.0, 1.0, (2, 2)), 2, axis=1)
    width = float(chance.uniform(2.0, 20.0))
    levels, spread_out = spread(z, velocity, lambda at: width)
    assert np.all(np.diff(levels) > 0.0)
    for at, side in (([0.0, 40.0 - width], 0), ([40.0 + width, 100.0], -1)):
        kept = np.array([np.interp(at, levels, part) for part in spread_out])
        assert kept == pytest.approx(velocity[:, [side, side]])
    fine = np.linspace(40.0 - 0.5 * width, 40.0 + 0.5 * width, 20001)
    flat = np.array([np.interp(fine, levels, part) for part in spread_out])
    load = np.trapezoid(np.linalg.norm(flat, axis=0) * flat, fine, axis=1)
    sides = [np.linalg.norm(u) * u for u in (velocity[:, 0], velocity[:, -1])]
    largest = max(np.abs(sides).max(), 1e-3)
    assert load / width == pytest.approx(0.5 * (sides[0] + sides[1]), abs=3e-3 * largest)


def test_three_points_at_one_elevation_are_refused():
    points = [{"elevation": f"{z} m", "speed": "1 m/s"} for z in (0, 50, 50, 50, 400)]
    with pytest.raises(InputError, match="two points at one elevation define a jump"):
        string(points)
