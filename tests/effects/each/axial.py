"""Axial: a case, the plain version, and a bar that stretches by its weight.

tests/verification/test_consistency_with_closed_forms.py has the elastic catenary.
"""

from __future__ import annotations

import numpy as np
from plain import axial
from small_scenes import simulated
from surroundings import SEGMENTS, Case

from riserstudy.effects.axial import Axial

SCENE = """\
title: bar that stretches
riser: [{name: bar, length: 100 m, axial_stiffness: 200 MN, submerged_weight: 2 kN/m}]
bottom: {hold: wellhead, elevation: 0 m}
top: {z: free, tension: 1 MN}
analysis: {mesh: {elements: 10}}
"""


CASES = {Axial: Case(lambda d: Axial(8e8 * SEGMENTS))}

PLAIN = {Axial: [("string", axial)]}


def test_a_heavy_bar_stretches_by_the_mean_of_its_tension(tmp_path):
    """Elongation = the integral of T / EA, with T = 1 MN - w (L - s)."""
    found = simulated(tmp_path, SCENE)
    s = found["s"].values
    stretch = (1e6 * s - 2e3 * (100.0 * s - 0.5 * s**2)) / 200e6
    np.testing.assert_allclose(found["z"], s + stretch, rtol=1e-9)
