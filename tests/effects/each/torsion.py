"""Torsion: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case, N

from riserstudy.effects.torsion import Torsion


def torsion(record, s):
    out = np.zeros_like(s.force)
    out[-1, record.yaw] = -record.stiffness * s.r[-1, record.yaw]
    return {"force": out}


CASES = {Torsion: Case(lambda d: Torsion(N + 1, 2e5), directions=(3,), loose=1)}

PLAIN = {Torsion: [("device", torsion)]}
