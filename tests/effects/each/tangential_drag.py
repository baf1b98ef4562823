"""Tangential drag: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import along
from surroundings import SEGMENTS, Case, sheared

from riserstudy.effects.tangential_drag import TangentialDrag


def tangential_drag(record, s):
    _, tangent = along(s)
    slip = s.water - s.v
    u = (0.5 * (slip[:, :-1] + slip[:, 1:]) * tangent).sum(axis=0)
    half, out = 0.5 * record.low * np.abs(u) * u * tangent, np.zeros_like(s.force)
    out[:, :-1] += half
    out[:, 1:] += half
    return {"force": out}


CASES = {
    TangentialDrag: Case(lambda d: TangentialDrag(2e4 * SEGMENTS), lambda d: [sheared(d)] if d > 1 else [])
}

PLAIN = {TangentialDrag: [("string", tangential_drag)]}

# without a load, in a plane on n segments
UNLOADED = {"tangential drag": lambda n: TangentialDrag(np.zeros(n))}
