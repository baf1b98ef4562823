"""Lift gauge: a case, and the plain version."""

from __future__ import annotations

from surroundings import CYLINDERS, Case

from riserstudy.effects.lift_gauge import LiftGauge


def lift_gauge(record, s):
    out = s.probe.copy()
    out[record.probe : record.probe + 2] = s.r[-1, 0] - record.elevation, s.v[-1, 0]
    return {"probe": out}


CASES = {
    LiftGauge: Case(lambda d: LiftGauge(-3.0, 2 * CYLINDERS)),
}

PLAIN = {
    LiftGauge: [("probe", lift_gauge)],
}
