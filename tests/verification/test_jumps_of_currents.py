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
from riserstudy.simulation.refine import run
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


@pytest.mark.long
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
    assert errors[80] < 2e-4  # of the string's sag, which the closed form neglects
    assert math.log2(errors[10] / errors[40]) / 2.0 > 1.8, errors


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


def uneven(chance, n):
    """Elevations of nodes whose segments differ in length by up to a factor of three."""
    size = chance.uniform(1.0, 3.0, n)
    return 100.0 * np.concatenate([[0.0], np.cumsum(size) / size.sum()])


def layers(chance, parts):
    """An even current with a thin layer and a jump at random elevations: elevations and velocities."""
    middle, jump = (float(chance.uniform(a, a + 20.0)) for a in (25.0, 55.0))
    half = 0.5 * 10.0 ** float(chance.uniform(-2.0, 1.0))
    z = np.array([-10.0, middle - half, middle, middle + half, jump, jump, 110.0])
    even_speed, layer, above = chance.uniform(-1.0, 1.0, (3, parts))
    velocity = np.array([even_speed, even_speed, 4.0 * layer, even_speed, even_speed, above, above])
    return z, velocity.T


def loads_of(z, velocity, places):
    """Speed times velocity of a current, (parts, places)."""
    flat = np.array([np.interp(places, z, part) for part in velocity])
    return np.linalg.norm(flat, axis=0) * flat


def lumped(load, size):
    """Loads of nodes from loads per length at nodes, by equation (5) of the theory."""
    whole = np.zeros_like(load)
    whole[:, :-1] += size * (5.0 * load[:, :-1] + load[:, 1:]) / 12.0
    whole[:, 1:] += size * (5.0 * load[:, 1:] + load[:, :-1]) / 12.0
    return whole


@pytest.mark.parametrize("even_mesh", [False, True])
@pytest.mark.parametrize("parts", [1, 2])
@pytest.mark.parametrize("seed", range(12))
def test_the_load_of_thin_layers_is_whole_on_any_mesh(seed, parts, even_mesh):
    chance = np.random.default_rng(seed)
    z, velocity = layers(chance, parts)
    n = int(chance.integers(20, 60))
    nodes = np.linspace(0.0, 100.0, n + 1) if even_mesh else uneven(chance, n)
    fine = np.unique(np.concatenate([np.linspace(0.0, 100.0, 400_001), z[1:-1] - 1e-9, z[1:-1] + 1e-9]))
    right = loads_of(z, velocity, fine)
    found = lumped(loads_of(*spread(z, velocity, nodes), nodes), np.diff(nodes))
    size = np.trapezoid(np.linalg.norm(right, axis=0), fine)
    assert found.sum(axis=1) == pytest.approx(np.trapezoid(right, fine, axis=1), abs=2e-3 * size)
    if even_mesh:
        about = np.trapezoid(right * fine, fine, axis=1)
        assert (found * nodes).sum(axis=1) == pytest.approx(about, abs=2e-3 * size * 100.0 / n)


@pytest.mark.parametrize("seed", range(5))
def test_far_from_layers_the_current_is_kept(seed):
    chance = np.random.default_rng(seed)
    z, velocity = layers(chance, 2)
    nodes = np.linspace(0.0, 100.0, 201)
    table, mean = spread(z, velocity, nodes)
    assert np.all(np.diff(table) > 0.0)
    far = np.linspace(-20.0, 120.0, 2001)
    far = far[np.abs(far[:, None] - z[1:-1]).min(axis=1) > 2.5]
    kept = np.array([np.interp(far, table, part) for part in mean])
    assert kept == pytest.approx(np.array([np.interp(far, z, part) for part in velocity]), abs=1e-9)


def in_a_jet(seed, width, speed, box):
    """A rig on inclined cylinders in a thin layer of fast current, in plane or in space."""
    spatial = bool(seed % 2)
    tree = rig(seed, spatial=spatial, conductor=False)
    chance = np.random.default_rng((seed, 77))
    seabed = tree["water"]["seabed"]
    level = float(chance.uniform(0.2, 0.8)) * seabed
    low, high = level - 0.5 * width, level + 0.5 * width
    inside = [(low, 0.2), (low, speed), (high, speed), (high, 0.2)]
    inside = inside if box else [(low, 0.2), (level, speed), (high, 0.2)]
    turn = float(chance.uniform(-60.0, 60.0)) if spatial else 0.0
    tree["current"] = {
        "profile": [
            {"elevation": f"{z!r} m", "speed": f"{u} m/s"}
            | ({"direction": f"{turn if u == speed else 20.0!r} deg"} if spatial else {})
            for z, u in [(seabed, 0.2), *inside, (60.0, 0.2)]
        ]
    }
    return SceneFile("rig.yaml", written(tree)).resolved()


@pytest.mark.parametrize("box", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_no_mesh_misses_a_jet_between_its_nodes(seed, box):
    file = in_a_jet(seed, 0.2, 8.0, box)
    runs = [single(file, even(file, n), None).arrays for n in (60, 2000)]
    for name in ("x_static", "y_static"):
        if name in runs[0]:
            fine = np.interp(runs[0]["s_node"], runs[1]["s_node"], runs[1][name])
            assert runs[0][name] == pytest.approx(fine, abs=0.01 * np.abs(fine).max()), name


@pytest.mark.parametrize("box", [False, True])
@pytest.mark.parametrize("seed, width", [(0, 20.0), (1, 20.0), (2, 20.0), (3, 20.0), (2, 2.0), (3, 2.0)])
def test_errors_in_a_jet_are_within_the_tolerance(seed, width, box):
    file = in_a_jet(seed, width, 3.0, box)
    found = run(file).arrays
    fine = single(file, even(file, 6000), None).arrays
    for name, tolerance in (("x_static", 2e-3), ("bending_moment_static", 1e-2)):
        right = np.abs(np.interp(found["s_node"], fine["s_node"], np.abs(fine[name])))
        assert np.abs(found[name]) == pytest.approx(right, abs=tolerance * right.max()), name


def test_three_points_at_one_elevation_are_refused():
    points = [{"elevation": f"{z} m", "speed": "1 m/s"} for z in (0, 50, 50, 50, 400)]
    with pytest.raises(InputError, match="at most two points"):
        string(points)
