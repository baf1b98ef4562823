"""Screening in a current that turns with depth: two modes of one frequency vibrate across the strongest flow.

A taut string has sines in any two directions. Of these, one direction receives most power from the current,
whose lift has the weight of the speed squared.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from riserstudy.design.vortex_screening import Coefficients, screening
from riserstudy.scene.load import SceneFile

LENGTH, TENSION, MASS, DRAG = 300.0, 2e6, 400.0, 1.1
FIRST = math.sqrt(TENSION / MASS) / (2.0 * LENGTH)  # Hz
FINE = 1000  # places along the string
PHASE = 2.0 * math.pi * (np.arange(16) + 0.5) / 16
TURNS = np.radians(np.arange(0.0, 180.0, 3.0))  # directions of vibration


def case(seed):
    """A scene with two layers of water, and diameter, speed and direction over elevation (m).

    The lower layer is deep and slow, the upper one thin and fast, and they flow in different directions. The
    lower part of the string is of another diameter.
    """
    draw = np.random.default_rng(seed)
    cut = 1.5 * float(draw.integers(110, 150))
    slow, fast = float(draw.uniform(0.1, 0.6)), float(draw.uniform(0.7, 1.1))
    ways = draw.uniform(-180.0, 180.0) + np.array([0.0, draw.uniform(50.0, 130.0) * draw.choice([-1, 1])])
    diameters = draw.uniform(0.4, 0.6, 2)
    sections = [
        {
            "name": f"part {k}",
            "length": f"{length} m",
            "axial_stiffness": "1 TN",
            "mass": f"{MASS} kg/m",
            "submerged_weight": "0 N/m",
            "outer_diameter": f"{diameters[k]} m",
            "drag": {"coefficient": DRAG, "diameter": f"{diameters[k]} m"},
        }
        for k, length in enumerate((cut, LENGTH - cut))
    ]
    points = [(0.0, slow, ways[0]), (cut, slow, ways[0]), (cut, fast, ways[1]), (LENGTH, fast, ways[1])]
    profile = [
        {"elevation": f"{z} m", "speed": f"{u} m/s", "direction": f"{math.remainder(way, 360.0)} deg"}
        for z, u, way in points
    ]
    tree = {
        "title": "string in two layers",
        "water": {"density": "1025 kg/m^3", "surface": f"{LENGTH} m"},
        "riser": sections,
        "bottom": {"hold": "wellhead", "elevation": "0 m"},
        "top": {"x": "held", "z": "free", "tension": f"{TENSION} N"},
        "analysis": {"mesh": {"elements": 200}},
        "current": {"profile": profile, "beyond": "hold"},
    }
    z = (np.arange(FINE) + 0.5) / FINE * LENGTH
    below = z < cut
    return tree, z, *(np.where(below, *two) for two in (diameters, (slow, fast), np.radians(ways)))


def amplitude(number, given, z, diameter, speed, way):
    """Largest relative amplitude (1) of a mode with some half-waves, in the direction that is driven most."""
    shape = abs(np.sin(math.pi * number * z / LENGTH))
    frequency = number * FIRST
    reduced = speed / (frequency * diameter)
    excited = (reduced >= given.slowest) & (reduced <= given.fastest)
    fastest = 2.0 * math.pi * frequency * np.cos(PHASE)[:, np.newaxis] * shape

    def gained(size, across):
        v = size * fastest
        lift = given.lift * excited * speed * np.cos(PHASE)[:, np.newaxis] * across
        return float((diameter * np.hypot(v, speed) * (lift - DRAG * v) * v).sum()) / size

    found = [brentq(gained, 1e-9, 5.0, args=(abs(np.sin(turn - way)),), rtol=1e-4) for turn in TURNS]
    return max(found) * (shape / diameter).max()


@pytest.mark.parametrize("seed", range(12))
def test_modes_vibrate_across_the_flow_that_drives_them_most(seed):
    tree, z, diameter, speed, way = case(seed)
    given = Coefficients(lift=0.8)
    found = screening(SceneFile("scene.yaml", tree), given)
    order = np.round(found["natural_frequency"].values / FIRST).astype(int)
    compared = 0
    for number in np.unique(order):
        reduced = speed / (number * FIRST * diameter)
        margin = np.minimum(abs(reduced / given.slowest - 1.0), abs(reduced / given.fastest - 1.0)).min()
        excited = (reduced > given.slowest) & (reduced < given.fastest)
        if margin < 0.02 or not excited.any():  # only within the segment where the layers meet
            continue
        largest = float(found["amplitude"].values[order == number].max())
        # 1 %: segments of 1.5 m at the edge of a layer, and the mean power in place of its balance
        assert largest == pytest.approx(amplitude(number, given, z, diameter, speed, way), rel=0.01), number
        compared += 1
    assert compared >= 1
