"""Drag: a case, the plain version, and a towed cable at its critical angle."""

from __future__ import annotations

import numpy as np
import pytest
from plain import pressed, spread
from small_scenes import simulated
from surroundings import SEGMENTS, Case, N, sheared

from riserstudy.effects.drag import Drag

SCENE = """\
title: cable towed through water
water: {density: 1000 kg/m^3, surface: 150 m, seabed: 0 m}
riser:
  - name: cable
    length: 100 m
    axial_stiffness: 1e12 N
    submerged_weight: 500 N/m
    drag: {coefficient: 1.0, diameter: 0.5 m}
bottom: {hold: free}
top: {x: held, z: held, elevation: 150 m}
current: {profile: [{elevation: 0 m, speed: 1.6 m/s}, {elevation: 200 m, speed: 1.6 m/s}]}
analysis: {mesh: {elements: 8}}
"""


def drag(record, s, tangent=None):
    return {"force": spread(record.low, pressed(record, s, tangent), record.up)}


CASES = {
    Drag: Case(
        lambda d: Drag(6e3 * SEGMENTS, 5e3 * SEGMENTS, np.zeros((d, N + 1)), 0), lambda d: [sheared(d)]
    )
}

PLAIN = {Drag: [("string", drag)]}

# without a load, in a plane on n segments
UNLOADED = {"drag": lambda n: Drag(np.zeros(n), np.zeros(n), np.zeros((2, n + 1)), 0)}


@pytest.mark.parametrize("direction", [None, "horizontal"])
def test_a_towed_cable_is_straight_at_its_critical_angle(tmp_path, direction):
    """From the vertical: w sin = q cos^2 across the cable, or w sin = q cos where drag is horizontal."""
    found = simulated(tmp_path, SCENE, {"riser[0].drag.direction": direction})
    ratio = 0.5 * 1000.0 * 0.5 * 1.6**2 / 500.0
    sine = (np.sqrt(1.0 + 4.0 * ratio**2) - 1.0) / (2.0 * ratio)
    angle = np.arctan(ratio) if direction else np.arcsin(sine)
    below = 100.0 - found["s"].values
    np.testing.assert_allclose(found["x"], below * np.sin(angle), atol=1e-5)
    np.testing.assert_allclose(found["z"], 150.0 - below * np.cos(angle), atol=1e-5)
    # across the cable, drag adds no tension; horizontal drag does
    along = np.hypot(1.0, ratio) if direction else np.cos(angle)
    assert float(found["effective_tension"][-1]) == pytest.approx(500.0 * 100.0 * along, rel=1e-6)
