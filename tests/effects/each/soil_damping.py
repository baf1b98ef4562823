"""Damping of soil: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case

from riserstudy.effects.soil_damping import SoilDamping


def soil_damping(record, s):
    out = np.zeros_like(s.force)
    np.add.at(out, (slice(-1), record.node), -record.damping * s.v[:-1, record.node])
    return {"force": out}


CASES = {
    SoilDamping: Case(lambda d: SoilDamping(np.arange(4), 3e5 * np.linspace(1.0, 2.0, 4)), directions=(2, 3))
}

PLAIN = {SoilDamping: [("device", soil_damping)]}
