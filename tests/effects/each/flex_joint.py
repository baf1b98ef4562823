"""Flex joint: a case, the plain version, and stiff rods on joints."""

from __future__ import annotations

import numpy as np
import pytest
from plain import along, angles, carried, rotations
from scipy.optimize import brentq
from small_scenes import simulated
from surroundings import Case, N, pipe

from riserstudy.effects.flex_joint import FlexJoint

BELOW = """\
title: stiff rod on a flex joint
riser: [{name: rod, length: 50 m, axial_stiffness: 1e13 N, bending_stiffness: 1e13 N*m^2}]
bottom: {hold: wellhead, elevation: 0 m, rotation: {stiffness: 10 MN*m/rad}}
top: {x: free, z: free, rotation: free, lateral_force: 100 kN}
analysis: {mesh: {elements: 8}}
"""
ABOVE = """\
title: stiff rod below a flex joint of a platform that leans
riser: [{name: rod, length: 50 m, axial_stiffness: 1e13 N, bending_stiffness: 1e13 N*m^2}]
bottom: {hold: free, body: {name: body, mass: 20 t, submerged_weight: 200 kN}}
top: {x: platform, z: platform, elevation: 100 m, rotation: {stiffness: 10 MN*m/rad}}
platform: {position: {LEAN: 10 deg}, centre_of_rotation: {elevation: 100 m}}
analysis: {mesh: {elements: 8}}
"""


def flex_joint(record, s):
    out = np.zeros(s.turn.shape)
    held = carried(s.platform, record.lean)[0]
    _, t = along(s)
    if len(t) == 3:
        out[:, -1:] = rotations(t[:, -1:], held[:, None])
    else:
        out[0, -1] = np.arctan2(held[0], held[2]) - angles(s)[-1]
    return {"turn": out}


CASES = {
    FlexJoint: Case(
        lambda d: FlexJoint(
            N, 1e-7, np.array([0.06, -0.08, np.sqrt(0.99)] if d > 2 else [0.6, 0.0, 0.8]), 1, np.zeros((3, 3))
        ),
        lambda d: [pipe(d)],
        (2, 3),
    )
}

PLAIN = {FlexJoint: [("place turn", flex_joint)]}


def test_a_stiff_rod_leans_until_its_joint_carries_the_moment_of_the_force(tmp_path):
    """K theta = F L cos(theta), at 0.45 rad."""
    found = simulated(tmp_path, BELOW)
    angle = brentq(lambda a: 10e6 * a - 100e3 * 50.0 * np.cos(a), 0.0, 1.0)
    # the rod bends by 4e-4 m
    np.testing.assert_allclose(found["x"], found["s"] * np.sin(angle), atol=1e-3)
    np.testing.assert_allclose(found["z"], found["s"] * np.cos(angle), atol=1e-3)
    moment = float(np.abs(found["bending_moment"][0]))
    assert moment == pytest.approx(10e6 * angle, rel=1e-4)


@pytest.mark.parametrize("lean, sideways, sign", [("pitch", "x", -1.0), ("roll", "y", 1.0)])
def test_a_rod_below_a_leaning_platform_hangs_between_its_joint_and_its_weight(
    tmp_path, lean, sideways, sign
):
    """K (phi - theta) = W L sin(theta); pitch leans the platform's vertical to +x, roll to -y."""
    found = simulated(tmp_path, ABOVE.replace("LEAN", lean))
    phi = np.radians(10.0)
    angle = brentq(lambda a: 10e6 * (phi - a) - 200e3 * 50.0 * np.sin(a), 0.0, phi)
    below = 50.0 - found["s"]
    np.testing.assert_allclose(found[sideways], sign * below * np.sin(angle), atol=1e-3)
    np.testing.assert_allclose(found["z"], 100.0 - below * np.cos(angle), atol=1e-3)
