"""Drag: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import pressed, spread
from surroundings import SEGMENTS, Case, N, sheared

from riserstudy.effects.drag import Drag


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
