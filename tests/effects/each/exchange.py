"""Exchange: a case, the plain version, and paths and loads that a table holds exactly.

tests/verification/test_staggered_coupling.py has the energy and the error of the exchange over time.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial import Polynomial
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


def stirred_rig(*args, **changes):
    from rig import Rig  # which imports this file

    return Rig(*args, **changes)


CUBIC = Polynomial([1.0, -2.0, 0.7, 0.3])


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize("time", [0.0, 1.7, 4.3, 8.0])
def test_a_motion_that_is_a_cubic_of_time_is_handed_over_exactly(d, time):
    """Its acceleration is linear in time, as the table has it."""
    record = stirred_rig(MotionTable, d).record
    derivatives = [CUBIC, CUBIC.deriv(), CUBIC.deriv(2)]
    path = np.array([np.outer(p(record.time), np.arange(1.0, d)) for p in derivatives])
    rig = stirred_rig(MotionTable, d, path=path)
    rig.s.clock[0] = time
    rig.place()
    for array, p in zip((rig.s.r, rig.s.v, rig.s.a), derivatives, strict=True):
        np.testing.assert_allclose(array[:-1, N], p(time) * np.arange(1.0, d), rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("d", [2, 3])
def test_a_force_that_grows_with_time_is_handed_over_exactly_and_works_as_it_moves(d):
    record = stirred_rig(ForceTable, d).record
    slopes = 1e5 * np.arange(1.0, d)
    rig = stirred_rig(ForceTable, d, load=np.outer(record.time - 2.0, slopes))
    for time in (0.5, 4.3, 7.9):
        rig.s.clock[0] = time
        force = rig.evaluate()[rig.m :]
        np.testing.assert_allclose(force[:-1, record.node], (time - 2.0) * slopes, rtol=1e-12)
        assert not force[-1].any()
        speed = rig.s.v[:-1, record.node]
        assert rig.flow() == (0.0, pytest.approx((time - 2.0) * slopes @ speed, rel=1e-12))
