"""Inner flex joint: a case, the plain version, and stiff rods with a joint between them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq
from small_scenes import simulated
from surroundings import Case, pipe

from riserstudy.effects.inner_flex_joint import InnerFlexJoint

SCENE = """\
title: stiff rods with a flex joint between them
riser:
  - {name: lower, length: 20 m, axial_stiffness: 1e13 N, bending_stiffness: 1e13 N*m^2}
  - name: upper
    length: 30 m
    axial_stiffness: 1e13 N
    bending_stiffness: 1e13 N*m^2
    flex_joint_below: {stiffness: 5 MN*m/rad}
bottom: {hold: wellhead, elevation: 0 m, rotation: fixed}
top: {x: free, z: free, rotation: free, lateral_force: 100 kN}
analysis: {mesh: {elements: 10}}
"""


def inner_flex_joint(record, s):
    out = s.probe.copy()
    moment = s.moment[0, record.node] if len(s.dim) == 2 else np.linalg.norm(s.moment[:, record.node])
    out[record.probe] = record.flex * moment
    if len(s.dim) == 3:
        out[record.probe + 1 : record.probe + 4] = record.flex * s.moment[:, record.node]
    return {"probe": out}


CASES = {InnerFlexJoint: Case(lambda d: InnerFlexJoint(3, 2e-7, 0), lambda d: [pipe(d)], (2, 3))}

PLAIN = {InnerFlexJoint: [("probe", inner_flex_joint)]}


def test_the_rod_above_leans_until_the_joint_carries_the_moment_of_the_force(tmp_path):
    """K alpha = F L cos(alpha) above the joint, at 0.53 rad; below, the rod stays upright."""
    found = simulated(tmp_path, SCENE)
    angle = brentq(lambda a: 5e6 * a - 100e3 * 30.0 * np.cos(a), 0.0, 1.0)
    above = np.maximum(found["s"] - 20.0, 0.0)
    # the rods bend by 4e-4 m
    np.testing.assert_allclose(found["x"], above * np.sin(angle), atol=1e-3)
    np.testing.assert_allclose(found["z"], found["s"] - above * (1.0 - np.cos(angle)), atol=1e-3)
    assert float(np.abs(found["lfj_angle"].squeeze())) == pytest.approx(angle, rel=1e-4)
