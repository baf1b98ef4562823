"""Exchange: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicHermiteSpline
from surroundings import CYLINDERS, Case, N, stirred

from riserstudy.effects.exchange import ForceTable, MotionTable


def lent_force(record, s):
    out = np.zeros_like(s.force)
    for c, load in enumerate(record.load.T):
        out[c, record.node] = np.interp(s.clock[0], record.time, load)
    return {"force": out}


def lent_force_reports(record, s):
    out = s.probe.copy()
    moves = [(s.v[c, record.node], s.a[c, record.node]) for c in range(record.load.shape[1])]
    out[record.probe : record.probe + 2 * len(moves)] = np.ravel(moves)
    return {"probe": out}


def told_motion(record, s):
    out = {name: getattr(s, name).copy() for name in "rva"}
    for c in range(record.path.shape[2]):
        path = CubicHermiteSpline(record.time, record.path[0, :, c], record.path[1, :, c])
        out["r"][c, record.node] = path(s.clock[0])
        out["v"][c, record.node] = path(s.clock[0], 1)
        out["a"][c, record.node] = np.interp(s.clock[0], record.time, record.path[2, :, c])
    return out


CASES = {
    ForceTable: Case(
        lambda d: ForceTable(2, np.array([0.0, 3.0, 5.5, 8.0]), 1e5 * stirred(4, d - 1), 2 * CYLINDERS),
        directions=(2, 3),
    ),
    MotionTable: Case(
        lambda d: MotionTable(N, np.array([0.0, 3.0, 5.5, 8.0]), stirred(3, 4, d - 1)), directions=(2, 3)
    ),
}

PLAIN = {
    ForceTable: [("device", lent_force), ("probe", lent_force_reports)],
    MotionTable: [("place", told_motion)],
}
