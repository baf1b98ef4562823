"""Cylinder: a case, the plain version, and a bar below upright cylinders."""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest
from small_scenes import simulated
from surroundings import Case, cylinders

from riserstudy.effects.cylinder import Upright

SCENE = """\
title: bar on upright cylinders
riser: [{name: bar, length: 100 m, axial_stiffness: 100 MN}]
bottom: {hold: wellhead, elevation: 0 m}
top:
  z: free
  tensioners: {count: 4, linear: {tension: 250 kN, stiffness: 50 kN/m}, mid_stroke: riser in equilibrium}
platform: {position: {heave: 2 m}}
analysis: {mesh: {elements: 5}}
"""


def upright(record, s):
    force = np.zeros_like(s.force)
    force[-1, record.node] = s.pull.sum()
    x, y, z = record.arm
    (roll, pitch), (rolling, pitching) = s.platform[0, 3:5], s.platform[1, 3:5]
    high, aside = cos(roll) * z + sin(roll) * y, cos(roll) * y - sin(roll) * z  # after the roll
    heave = s.platform[0, 2] - sin(pitch) * x + cos(pitch) * high - z
    turning = cos(pitch) * rolling * aside - pitching * (cos(pitch) * x + sin(pitch) * high)
    heaving = s.platform[1, 2] + turning
    reach = heave - s.r[-1, record.node] + record.zero
    rate = heaving - s.v[-1, record.node] + 0.0 * record.zero
    return {"force": force, "reach": reach, "reach_rate": rate}


CASES = {Upright: Case(cylinders)}

PLAIN = {Upright: [("drive device", upright)]}


@pytest.mark.parametrize("heave", [2.0, -1.5])
def test_four_cylinders_and_a_bar_share_a_heave_as_springs_in_series(tmp_path, heave):
    found = simulated(tmp_path, SCENE, {"platform.position.heave": f"{heave} m"})
    cylinders, bar = 4 * 50e3, 100e6 / 100.0
    pull = 1e6 + heave / (1.0 / cylinders + 1.0 / bar)
    np.testing.assert_allclose(found["effective_tension"], pull, rtol=1e-9)
    reach = heave * bar / (cylinders + bar)
    np.testing.assert_allclose(found["tensioner_stroke"], reach, rtol=1e-7)
    np.testing.assert_allclose(found["tensioner_force"].sum("cylinder"), pull, rtol=1e-9)
