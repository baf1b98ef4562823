"""Munk: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import by_angle, of_hull
from surroundings import Case, N, pair

from riserstudy.effects.munk import Munk


def munk(record, s):
    axes, rate, v, _ = of_hull(record, s)

    def tensor(angle):
        ahead = np.array([np.cos(angle), np.sin(angle)])
        return record.difference * np.outer(ahead, ahead)

    turned = by_angle(tensor, np.arctan2(axes[0, 1], axes[0, 0]))
    out = np.zeros_like(s.force)
    out[:2, record.node] = rate * turned @ record.current
    out[2, -1] = (0.5 * record.current - v) @ turned @ record.current / record.radius
    return {"force": out}


CASES = {Munk: Case(lambda d: Munk(N, N + 1, 50.0, 0.4, -3e7, pair(0.5, 0.3)), directions=(3,), loose=1)}

PLAIN = {Munk: [("device", munk)]}
