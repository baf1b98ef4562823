"""First-order motion: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import carried
from surroundings import TOP, Case, N, pair

from riserstudy.effects.first_order_motion import FirstOrderMotion


def first_order_motion(record, s):
    """What the top has beside its own; accelerations by differences, and that it moves: compared apart."""
    lateral = len(s.r) - 1
    moved = s.platform[:, :3] + carried(s.platform, record.arm)
    moved[0] -= record.arm
    out = s.carried.copy()
    out[:2, :lateral] = moved[:2, :lateral]
    return {"carried": out}


CASES = {
    FirstOrderMotion: Case(
        lambda d: FirstOrderMotion(
            N, d - 1, pair(1.0, -2.0), np.array([3.0, -1.0, TOP]), np.zeros((3, 3)), 0
        ),
        directions=(2, 3),
    )
}

PLAIN = {FirstOrderMotion: [("place", first_order_motion)]}
