"""A current that turns with depth has one velocity at each depth, in a scene and in its deck.

A deck is interpolated in speed and direction, a scene in the components of the velocity.
"""

import math

import numpy as np
import pytest
from drawn_decks import drawn, file_of
from exported_rigs import turning
from ruamel.yaml import YAML

from riserstudy.export.orcaflex import write_deck
from riserstudy.importers.orcaflex import read_deck
from riserstudy.model.sea import current_velocity

KEY = "CurrentDepth, CurrentFactor, CurrentRotation"
CLOSE = 2e-3  # share of the greatest speed: 0.1 % in each of two directions


def by_components(points, depth):
    """Velocity (m/s) as a complex number, interpolated in its components between points of a scene."""
    at, speed, angle = (
        np.array([float(point[name].split()[0]) for point in points])
        for name in ("depth", "speed", "direction")
    )
    velocity = speed * np.exp(1j * np.radians(angle))
    return np.interp(depth, at, velocity.real) + 1j * np.interp(depth, at, velocity.imag)


def by_direction(rows, depth):
    """Velocity (m/s) as a complex number, interpolated in speed and direction between rows of a deck."""
    at, speed, angle = np.array(rows).T
    return np.interp(depth, at, speed) * np.exp(1j * np.radians(np.interp(depth, at, angle)))


def drawn_current(seed):
    draw = np.random.default_rng(seed)
    depth = float(draw.uniform(100, 2000))
    flow = turning(draw, depth)
    if seed % 3 == 0:  # back the way it came, through rest
        ways = [float(point["direction"].split()[0]) for point in flow["profile"]]
        flow["profile"][1]["direction"] = f"{math.remainder(ways[0] + 180.0, 360.0)} deg"
    if seed % 4 == 0:
        flow["profile"][2]["speed"] = "0 m/s"
    return flow, np.linspace(0.0, 1.2 * depth, 1001)


@pytest.mark.parametrize("seed", range(12))
def test_a_deck_has_the_velocity_of_the_scene_at_all_depths(seed):
    flow, depth = drawn_current(seed)
    deck = YAML(typ="safe").load(write_deck(file_of(drawn(0) | {"current": flow})).text)
    rows = deck["Environment"][KEY]
    assert (np.diff(np.array(rows)[:, 0]) > 0.0).all()
    error = np.abs(by_direction(rows, depth) - by_components(flow["profile"], depth))
    assert error.max() < 0.7 * CLOSE


@pytest.mark.parametrize("seed", range(12))
def test_a_scene_has_the_velocity_of_its_deck_at_all_depths(tmp_path, seed):
    """Rotations of any number of turns, and a reference direction beside them."""
    draw = np.random.default_rng(seed)
    text = write_deck(file_of(drawn(1))).text
    deck = YAML(typ="safe").load(text)
    depths = [0.0, *np.sort(draw.uniform(10.0, 900.0, 3)).tolist()]
    rows = [[z, float(draw.uniform(0.2, 1.0)), float(draw.uniform(-300, 500))] for z in depths]
    towards = float(draw.uniform(-180, 360))
    deck["Environment"] |= {KEY: rows, "RefCurrentSpeed": 0.8, "RefCurrentDirection": towards}
    path = tmp_path / "deck.yml"
    with path.open("w") as file:
        YAML().dump(deck, file)
    imported = read_deck(path)
    scene = file_of(imported.tree, path).resolved()
    z, velocity = current_velocity(scene.current, scene.water)
    depth = np.linspace(0.0, 1000.0, 1001)
    ours = np.array([np.interp(scene.water.surface - depth, z, part) for part in velocity])
    theirs = 0.8 * by_direction(rows, depth) * np.exp(1j * math.radians(towards))
    assert np.abs(ours[0] + 1j * ours[1] - theirs).max() < 0.8 * CLOSE
    assert any("points are added" in line for line in imported.left_out)


@pytest.mark.parametrize("seed", range(6))
def test_a_profile_above_the_water_begins_at_the_surface_of_a_deck(seed):
    draw = np.random.default_rng(seed)
    low, high = float(draw.uniform(-900, -50)), float(draw.uniform(1, 60))
    ends = [(low, 0.1), (high, 0.9)]
    profile = [{"elevation": f"{z} m", "speed": f"{speed} m/s"} for z, speed in ends]
    flow = {"profile": profile, "beyond": "hold"}
    exported = write_deck(file_of(drawn(0) | {"current": flow}))
    first = YAML(typ="safe").load(exported.text)["Environment"][KEY][0]
    assert first[0] == 0.0
    assert first[1] == pytest.approx(0.1 + 0.8 * (0.0 - low) / (high - low))
    assert any(line.startswith("current.profile: above the water") for line in exported.left_out)


def test_points_that_a_deck_does_not_have_are_named():
    """A curve of 2001 points is thinned."""
    shape = {"shape": "exponential", "scale": "50 m", "surface_speed": "1 m/s"}
    exported = write_deck(file_of(drawn(0) | {"current": {"profile": shape}}))
    assert any("current.profile: a table of" in line for line in exported.left_out)
