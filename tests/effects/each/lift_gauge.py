"""Lift gauge: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import CYLINDERS, Case

from riserstudy.effects.lift_gauge import LiftGauge


def lift_gauge(record, s):
    out = s.probe.copy()
    aside = np.linalg.norm(s.r[:-1, 0])
    out[record.probe : record.probe + 3] = s.r[-1, 0] - record.elevation, s.v[-1, 0], aside
    return {"probe": out}


CASES = {LiftGauge: Case(lambda d: LiftGauge(-3.0, 2 * CYLINDERS))}

PLAIN = {LiftGauge: [("probe", lift_gauge)]}
