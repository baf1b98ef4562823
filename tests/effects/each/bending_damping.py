"""Bending damping: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import along
from surroundings import MOMENTS, Case, N, nodes, pipe

from riserstudy.effects.bending_damping import BendingDamping


def bending_damping(record, s):
    length, t = along(s)
    if len(t) == 3:
        swing = np.cross(t, np.diff(s.v, axis=1), axis=0) / length
    else:
        dv = np.diff(s.v, axis=1)
        swing = ((t[1] * dv[0] - t[0] * dv[1]) / length)[None, :]
    return {"turn": record.time * nodes(swing)}


CASES = {
    BendingDamping: Case(
        lambda d: BendingDamping(0.4, *np.zeros((2, MOMENTS[d], N + 1))), lambda d: [pipe(d)], (2, 3)
    )
}

PLAIN = {BendingDamping: [("turn", bending_damping)]}

# without a load, in a plane on n segments
UNLOADED = {"bending damping": lambda n: BendingDamping(0.0, np.zeros((1, n + 1)), np.zeros((1, n + 1)))}
