"""Sums of named profiles, by their formulas at drawn elevations, and the spiral by its equation of motion."""

import math

import numpy as np
import pytest

from riserstudy.model.sea import current_table, current_velocity, surface_current
from riserstudy.scene.forcing import Current
from riserstudy.scene.water import Water

SEABED, SURFACE = -400.0, 20.0
WATER = Water(density="1025 kg/m^3", seabed=f"{SEABED} m", surface=f"{SURFACE} m")
UNITS = {
    "surface_speed": "m/s", "speed": "m/s", "wind_speed": "m/s", "scale": "m", "layer": "m", "vanishes": "m",
    "elevation": "m", "seabed": "m", "surface": "m", "latitude": "rad", "heading": "rad", "depth_factor": "s",
}  # fmt: skip
DEPTH = SURFACE - SEABED


def given(part):
    """A part of a scene as it is written, with units."""
    if isinstance(part, list):
        return [given(one) for one in part]
    if isinstance(part, dict):
        return {name: f"{of!r} {UNITS[name]}" if name in UNITS else given(of) for name, of in part.items()}
    return part


def current_of(profile, **more):
    """A current of a profile."""
    return Current.model_validate(given({"profile": profile, "beyond": "hold"} | more))


def drawn(draw, kind):
    """A named profile, and its speed at a depth below the surface."""
    speed = float(draw.uniform(-1.0, 2.0))
    one = {"shape": kind, "surface_speed": speed}
    if kind == "uniform":
        return one, lambda depth: speed
    if kind == "power":
        power = float(draw.uniform(0.1, 3.0))
        return one | {"power": power}, lambda depth: speed * (1.0 - depth / DEPTH) ** power
    if kind == "exponential":
        scale = float(draw.uniform(20.0, 300.0))
        return one | {"scale": scale}, lambda depth: speed * math.exp(-depth / scale)
    layer, vanishes = (float(one) for one in np.sort(draw.uniform(1.0, 390.0, 2)))
    share = lambda depth: min(max((vanishes - depth) / (vanishes - layer), 0.0), 1.0)  # noqa: E731
    return one | {"layer": layer, "vanishes": vanishes}, lambda depth: speed * share(depth)


def drift(draw, component):
    """A drift under a wind of 10 m/s and more."""
    one = {"wind_speed": float(draw.uniform(10.0, 25.0)), "latitude": float(draw.uniform(0.4, 1.2)),
           "surface_factor": 0.0127, "depth_factor": float(draw.uniform(4.0, 7.6)),
           "component": component}  # fmt: skip
    return one | ({"hemisphere": str(draw.choice(["northern", "southern"]))} if component == "both" else {})


@pytest.mark.parametrize("seed", range(30))
def test_a_sum_has_the_speeds_of_its_parts_together(seed):
    draw = np.random.default_rng(seed)
    kinds = [str(k) for k in draw.choice(["uniform", "power", "exponential", "layer"], draw.integers(1, 4))]
    parts, laws = zip(*(drawn(draw, kind) for kind in kinds), strict=True)
    heading = float(draw.uniform(-3.0, 3.0))
    profile = {"sum": list(parts)} if len(parts) > 1 or seed % 2 else parts[0]
    current = current_of(profile, heading=heading)
    z, speeds = current_table(current, WATER)
    assert (z[0], z[-1]) == (SEABED, SURFACE)
    depths = draw.uniform(0.0, 0.98 * DEPTH, 100)
    expected = [sum(law(depth) for law in laws) for depth in depths]
    np.testing.assert_allclose(np.interp(SURFACE - depths, z, speeds), expected, atol=2e-4)
    along, velocity = current_velocity(current, WATER)
    np.testing.assert_array_equal(along, z)
    np.testing.assert_allclose(velocity, [speeds * math.cos(heading), speeds * math.sin(heading)])
    top = sum(law(0.0) for law in laws)
    assert surface_current(current, WATER) == pytest.approx(
        [top * math.cos(heading), top * math.sin(heading)], abs=1e-6
    )


@pytest.mark.parametrize("seed", range(20))
def test_parts_hold_their_end_values_beyond_their_own_levels(seed):
    """Also of a riser whose water has no levels."""
    draw = np.random.default_rng(seed)
    parts, ends = [], []
    for _ in range(2):
        low, high = (float(z) for z in np.sort(draw.uniform(-400.0, 20.0, 2)))
        power, speed = float(draw.uniform(0.5, 3.0)), float(draw.uniform(-1.0, 2.0))
        levels = {"seabed": low, "surface": high}
        parts.append({"shape": "power", "surface_speed": speed, "power": power} | levels)
        ends.append((low, high, power, speed))
    current = current_of({"sum": parts})
    z, speeds = current_table(current, None)
    lows, highs, *_ = zip(*ends, strict=True)
    assert (z[0], z[-1]) == (min(lows), max(highs))
    places = draw.uniform(z[0], z[-1], 100)
    expected = sum(
        speed * np.clip((places - low) / (high - low), 0.0, 1.0) ** power for low, high, power, speed in ends
    )
    np.testing.assert_allclose(np.interp(places, z, speeds), expected, atol=2e-2)
    assert surface_current(current, None) == pytest.approx([speeds[-1], 0.0], abs=1e-6)


@pytest.mark.parametrize("seed", range(20))
def test_a_drift_obeys_the_balance_of_friction_and_rotation(seed):
    """A d2w/dz2 = i f w, of w = u + i v: at every depth, the curvature is across the velocity.

    Its sense and the direction at the surface, 45 degrees from the wind, depend on the hemisphere.
    """
    draw = np.random.default_rng(seed)
    part, heading = drift(draw, "both"), float(draw.uniform(-3.0, 3.0))
    tide, law = drawn(draw, "exponential")
    current = current_of({"sum": [part, tide]}, heading=heading)
    z, velocity = current_velocity(current, WATER)
    side = 1.0 if part["hemisphere"] == "southern" else -1.0
    away = np.array([law(SURFACE - one) for one in z]) * np.exp(1j * heading)
    w = (velocity[0] + 1j * velocity[1] - away) * np.exp(-1j * heading)
    size = part["wind_speed"] / math.sqrt(math.sin(part["latitude"]))
    assert w[-1] == pytest.approx(0.0127 * size * np.exp(0.25j * math.pi * side), rel=1e-6)
    k = len(z) - 40
    h = z[k + 1] - z[k]
    bend = (w[k + 1] - 2.0 * w[k] + w[k - 1]) / h**2
    wanted = -2.0j * side * (math.pi / (part["depth_factor"] * size)) ** 2 * w[k]
    assert bend == pytest.approx(wanted, rel=1e-3)


@pytest.mark.parametrize("seed", range(10))
def test_components_of_a_drift_are_those_of_both(seed):
    draw = np.random.default_rng(seed)
    part = drift(draw, "both")
    z, velocity = current_velocity(current_of(part), WATER)
    plain = {name: value for name, value in part.items() if name != "hemisphere"}
    own = {
        component: current_table(current_of(plain | {"component": component}), WATER)[1]
        for component in ("along the wind", "across the wind", "magnitude")
    }
    np.testing.assert_allclose(own["along the wind"], velocity[0], atol=1e-12)
    np.testing.assert_allclose(
        own["across the wind"], abs(velocity[1]) * np.sign(own["across the wind"]), atol=1e-12
    )
    assert own["across the wind"][-1] > 0.0
    np.testing.assert_allclose(own["magnitude"], np.hypot(*velocity), atol=1e-12)


@pytest.mark.parametrize("ends", [(0.0, 0.5), (0.5, 0.0), (0.3, -0.4), (0.0, 0.0)])
def test_still_water_beyond_a_table_begins_with_a_jump_where_its_end_flows(ends):
    points = [{"elevation": z, "speed": v} for z, v in ((-300.0, ends[0]), (-100.0, 0.7), (0.0, ends[1]))]
    current = current_of(points, beyond="zero")
    z, speeds = current_table(current, WATER)
    table = [(-300.0, ends[0]), (-100.0, 0.7), (0.0, ends[1])]
    expected = [*[(-300.0, 0.0)] * bool(ends[0]), *table, *[(0.0, 0.0)] * bool(ends[1])]
    assert [*zip(z.tolist(), speeds.tolist(), strict=True)] == expected
