"""Stress gauge: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import along
from surroundings import Case, pipe

from riserstudy.effects.stress_gauge import StressGauge


def stress_gauge(record, s):
    out = s.probe.copy()
    size = np.sqrt((s.moment**2).sum(axis=0))
    ends = np.maximum(size[:-1], size[1:])
    axial = abs((s.segment * along(s)[1]).sum(axis=0)) / record.area
    out[record.probe] = (axial + record.fibre * ends)[record.first : record.last].max()
    return {"probe": out}


CASES = {StressGauge: Case(lambda d: StressGauge(1, 4, 0.05, 120.0, 0), lambda d: [pipe(d)], (2, 3))}

PLAIN = {StressGauge: [("probe", stress_gauge)]}
