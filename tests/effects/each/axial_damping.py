"""Axial damping: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import along
from surroundings import SEGMENTS, Case, nodes

from riserstudy.effects.axial_damping import AxialDamping


def axial_damping(record, s):
    _, tangent = along(s)
    rate = (np.diff(s.v, axis=1) * tangent).sum(axis=0)
    return {"force": nodes(record.damping * rate * tangent)}


CASES = {AxialDamping: Case(lambda d: AxialDamping(3e6 * SEGMENTS))}

PLAIN = {AxialDamping: [("string", axial_damping)]}

# without a load, in a plane on n segments
UNLOADED = {"axial damping": lambda n: AxialDamping(np.zeros(n))}
