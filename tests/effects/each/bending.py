"""Bending: a case, the plain version, and a beam on two supports.

tests/verification/test_consistency_with_closed_forms.py has the elastica and a beam under tension.
"""

from __future__ import annotations

import numpy as np
from plain import along, angles
from small_scenes import simulated
from surroundings import Case, flexibility, nodes, pipe

from riserstudy.effects.bending import Bending

SCENE = """\
title: beam on two supports
riser:
  - {name: beam, length: 50 m, axial_stiffness: 10 GN, bending_stiffness: 300 MN*m^2, lateral_load: 10 N/m}
bottom: {hold: wellhead, elevation: 0 m, rotation: free}
top: {x: held, z: free, rotation: free}
analysis: {mesh: {elements: 20}}
"""


def bending(record, s):
    length, tangent = along(s)
    turn = np.zeros(s.turn.shape)
    turn[0, 1:-1] = np.diff(angles(s))
    turn[0] -= flexibility(s) @ s.moment[0]
    shear = -np.diff(s.moment[0]) / length
    across_segment = np.array([tangent[1], -tangent[0]])
    return {"turn": turn, "force": nodes(shear * across_segment)}


CASES = {Bending: Case(pipe, directions=(2,))}

PLAIN = {Bending: [("turn string", bending)]}


def test_a_beam_on_two_supports_bends_as_by_its_closed_form(tmp_path):
    """w = q (L^3 s - 2 L s^3 + s^4) / (24 EI) and M = q s (L - s) / 2, at slopes of 2e-4."""
    found = simulated(tmp_path, SCENE)
    s = found["s"].values
    deflection = 10.0 * (50.0**3 * s - 2.0 * 50.0 * s**3 + s**4) / (24.0 * 300e6)
    np.testing.assert_allclose(found["x"], deflection, atol=1e-5 * deflection.max())
    moment = 0.5 * 10.0 * s * (50.0 - s)
    np.testing.assert_allclose(np.abs(found["bending_moment"]), moment, atol=1e-6 * moment.max())
