"""Bending: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import along, angles
from surroundings import Case, flexibility, nodes, pipe

from riserstudy.effects.bending import Bending


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
