"""Waterline: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case, N, sea

from riserstudy.effects.waterline import Waterline
from riserstudy.effects.wave import CONSTANT


def waterline(record, s):
    """Nodes with dry segments alone see no water; shares are tested with the waterline."""
    dry = record.surface + s.level < s.r[-1]
    alone = dry & np.append(True, dry[:-1]) & np.append(dry[1:], True)
    return {name: np.where(alone, 0.0, getattr(s, name)) for name in ("water", "water_rate")}


CASES = {
    Waterline: Case(
        lambda d: Waterline(45.0, np.ones((3, N)), np.ones(N), *np.ones((4, N))),
        lambda d: [sea(d, CONSTANT)] if d > 1 else [],
    )
}

PLAIN = {Waterline: [("drive", waterline)]}
