"""Currents that turn with depth: against the rod in space, the formula of the spiral, and plain currents."""

import math

import numpy as np
import pytest
from engine import off, scene
from scipy.integrate import solve_bvp

from riserstudy.errors import InputError
from riserstudy.model.mesh import even
from riserstudy.model.sea import current_velocity
from riserstudy.scene.forcing import Current
from riserstudy.scene.water import Water
from riserstudy.simulation.run import single

LENGTH, TENSION, WEIGHT, DENSITY, WIDTH = 533.0, 2275e3, 141.264, 1025.0, 1.22
STEEL = 206e9
EA = STEEL * math.pi / 4.0 * (0.5334**2 - 0.4826**2)
EI = STEEL * math.pi / 64.0 * (0.5334**4 - 0.4826**4)
#: elevation (m), speed (m/s), direction (deg)
POINTS = ((0.0, 0.1, 150.0), (200.0, 0.3, 100.0), (400.0, 0.8, 40.0), (540.0, 1.2, -20.0))


def profile(points, turned=0.0):
    return [
        {"elevation": f"{z} m", "speed": f"{v} m/s", "direction": f"{d + turned} deg"} for z, v, d in points
    ]


def ran(elements=320, **current):
    file = scene("s1", current=current).resolved()
    return file, single(file, even(file, elements), None).arrays


def rod(stations):
    """Position and moment of an extensible rod in space, pinned below, its top held aside and pulled upwards.

    Along the unstretched arclength s, with tangent t, force n and moment m on the part above:
    r' = (1 + t.n / EA) t,  t' = m x t / EI,  n' = w - q,  m' = n x r', drag q across the tangent.
    """
    z, speed, angle = np.array(POINTS).T
    flow = speed * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    drag = 0.5 * DENSITY * WIDTH

    def slope(s, y):
        r, t, n, m = y[:3], y[3:6], y[6:9], y[9:]
        stretched = (1.0 + (t * n).sum(axis=0) / EA) * t
        water = np.array([np.interp(r[2], z, part) for part in flow] + [np.zeros(len(s))])
        across = water - (water * t).sum(axis=0) * t
        load = drag * np.linalg.norm(across, axis=0) * across
        load[2] -= WEIGHT
        bend = np.cross(m, t, axis=0) / EI
        return np.concatenate([stretched, bend, -load, np.cross(n, stretched, axis=0)])

    def ends(low, up):
        return np.array(
            [*low[:3], low[3:6] @ low[3:6] - 1.0, *low[9:], up[0], up[1], up[8] - TENSION, *up[9:11]]
        )

    s = np.linspace(0.0, LENGTH, 201)
    guess = np.zeros((12, len(s)))
    guess[2], guess[5], guess[8] = s, 1.0, TENSION - WEIGHT * (LENGTH - s)
    found = solve_bvp(slope, ends, s, guess, tol=1e-7, max_nodes=20000)
    assert found.success, found.message
    y = found.sol(stations)
    return y[:3], np.linalg.norm(y[9:], axis=0)


@pytest.mark.long
def test_a_riser_in_a_turning_current_has_the_shape_of_the_rod_in_space():
    _, found = ran(profile=profile(POINTS))
    (x, y, z), moment = rod(found["s_node"])
    assert np.abs(x).max() > 1.0
    assert np.abs(y).max() > 1.0
    # lumped masses on 320 segments: second order, 1e-5 on these
    assert off(found["x_static"], x) < 1e-4
    assert off(found["y_static"], y) < 1e-4
    assert off(found["z_static"] - found["s_node"], z - found["s_node"]) < 1e-3
    assert off(found["bending_moment_static"], moment) < 1e-3


def test_one_direction_at_all_points_is_a_heading():
    plain = [{"elevation": f"{z} m", "speed": f"{v} m/s"} for z, v, _ in POINTS]
    _, heading = ran(60, profile=plain, heading="30 deg")
    _, points = ran(60, profile=profile([(z, v, 30.0) for z, v, _ in POINTS]))
    for name in ("x_static", "y_static", "bending_moment_static"):
        assert off(points[name], heading[name]) < 1e-9, name


def test_directions_along_x_stay_in_the_plane():
    both = [(0.0, 0.5, 180.0), (300.0, 0.2, 180.0), (540.0, 1.0, 0.0)]
    file, found = ran(60, profile=profile(both))
    assert not file.spatial
    signed = [{"elevation": "0 m", "speed": "-0.5 m/s"}, {"elevation": "300 m", "speed": "-0.2 m/s"}]
    _, plain = ran(60, profile=[*signed, {"elevation": "540 m", "speed": "1 m/s"}])
    assert off(found["x_static"], plain["x_static"]) < 1e-9


def test_from_is_the_other_way_and_a_turned_profile_turns_the_riser():
    _, towards = ran(60, profile=profile(POINTS))
    _, came = ran(60, profile=profile(POINTS, 180.0), headings="from")
    assert off(came["y_static"], towards["y_static"]) < 1e-9
    _, turned = ran(60, profile=profile(POINTS, 90.0))
    assert off(turned["y_static"], towards["x_static"]) < 1e-9
    assert off(-turned["x_static"], towards["y_static"]) < 1e-9


DRIFT = {
    "wind_speed": "20 m/s", "latitude": "30 deg", "surface_factor": 0.0127,
    "depth_factor": "7.6 s", "component": "both",
}  # fmt: skip
SEA = Water.model_validate({"density": "1025 kg/m^3", "surface": "0 m", "seabed": "-2000 m"})


def spiral(hemisphere, **changes):
    told = {"profile": DRIFT | {"hemisphere": hemisphere}, "heading": "50 deg"} | changes
    z, velocity = current_velocity(Current.model_validate(told), SEA)
    return z, velocity[0] + 1j * velocity[1]


@pytest.mark.parametrize("hemisphere, side", [("northern", -1.0), ("southern", 1.0)])
def test_the_spiral_is_ekmans(hemisphere, side):
    """u + iv = V exp(a z) exp(i (wind -+ (pi / 4 - a z))), a = pi / D."""
    z, found = spiral(hemisphere)
    strength = 20.0 / math.sqrt(0.5)
    a = math.pi / (7.6 * strength)
    speed = 0.0127 * strength * np.exp(a * z)
    wind = math.radians(50.0)
    expected = speed * np.exp(1j * (wind + side * (math.pi / 4.0 - a * z)))
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12)
    transport = np.trapezoid(found, z) / np.exp(1j * wind)
    # all of it at right angles to the wind, to the side of the hemisphere
    assert abs(transport.real) < 1e-3 * abs(transport.imag)
    assert np.sign(transport.imag) == side
    assert abs(transport) == pytest.approx(speed[-1] / (a * math.sqrt(2.0)), rel=1e-3)


def test_a_tide_adds_to_the_spiral_along_the_heading():
    tide = {"shape": "uniform", "surface_speed": "0.5 m/s"}
    both = {"sum": [tide, DRIFT | {"hemisphere": "northern"}]}
    z, found = spiral("northern", profile=both)
    _, drift = spiral("northern")
    np.testing.assert_allclose(found - drift, 0.5 * np.exp(1j * math.radians(50.0)), rtol=1e-9)
    assert len(z) == len(found)


@pytest.mark.parametrize(
    "told, said",
    [
        ({"profile": [*profile(POINTS)[:2], {"elevation": "540 m", "speed": "1 m/s"}]}, "in none"),
        ({"profile": profile(POINTS), "heading": "30 deg"}, "already have directions"),
        ({"profile": DRIFT}, "hemisphere"),
        ({"profile": DRIFT | {"component": "magnitude", "hemisphere": "northern"}}, "hemisphere"),
    ],
)
def test_directions_that_cannot_be_meant_are_refused(told, said):
    with pytest.raises(InputError, match=said):
        scene("s1", current=told).resolved()
