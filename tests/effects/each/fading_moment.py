"""Fading moment: a case, the plain version, and how the moment falls."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from plain import along, angles
from surroundings import Case, pipe

from riserstudy.effects.fading_moment import FadingMoment
from riserstudy.solve.evaluate import energies


def fading_moment(record, s):
    left = np.interp(s.clock[0], [record.start, record.start + record.over], [1.0, 0.0])
    moment, turn = s.moment.copy(), np.zeros_like(s.turn)
    moment[:, 0] = record.moment * np.sin(0.5 * np.pi * left) ** 2
    if len(s.dim) == 2:
        turn[0, 0] = angles(s)[0]
    else:
        t = along(s)[1][:, 0]
        across = np.cross([0.0, 0.0, 1.0], t)
        turn[:, 0] = across / np.linalg.norm(across) * np.arccos(t[2])
    return {"moment": moment, "turn": turn}


CASES = {
    FadingMoment: Case(
        lambda d: FadingMoment(2e5 * np.arange(1.0, {2: 2, 3: 4}[d]), 2.0, 4.5), lambda d: [pipe(d)], (2, 3)
    )
}

PLAIN = {FadingMoment: [("place turn", fading_moment)]}


def stirred_rig(*args, **changes):
    from rig import Rig  # which imports this file

    return Rig(*args, **changes)


@pytest.mark.parametrize("d", [2, 3])
def test_the_moment_falls_to_nothing_symmetrically_about_its_half(d):
    """Equal losses at equal times before and after the middle; half of its impulse is left by then."""
    rig = stirred_rig(FadingMoment, d)
    start, over, whole = rig.record.start, rig.record.over, rig.record.moment

    def at(share):
        rig.s.clock[0] = start + share * over
        rig.place()
        return rig.s.moment[:, 0] / whole

    for share, left in ((-0.5, 1.0), (0.0, 1.0), (0.5, 0.5), (1.0, 0.0), (2.0, 0.0)):
        np.testing.assert_allclose(at(share), left, atol=1e-15)
    # steepest in the middle: pi / 2 times the mean slope
    np.testing.assert_allclose((at(0.499) - at(0.501)) / 2e-3, 0.5 * np.pi, rtol=1e-5)
    impulse = np.mean([at((k + 0.5) / 64) for k in range(64)], axis=0)
    np.testing.assert_allclose(impulse, 0.5, rtol=1e-12)


@pytest.mark.parametrize("d", [2, 3])
def test_the_end_of_a_leaning_riser_has_the_angle_by_which_it_leans(d):
    """Upright, turned by 0.3 rad about a horizontal axis, towards a bearing of 0.5 rad in space."""
    rig = stirred_rig(FadingMoment, d)
    bearing = 0.5 if d == 3 else 0.0
    towards = np.array([np.cos(bearing), np.sin(bearing)])[: d - 1]
    place = np.append(0.0, np.cumsum(rig.s.l0))
    rig.s.r[:] = np.outer(np.append(np.sin(0.3) * towards, np.cos(0.3)), place)
    rig.s.clock[0] = rig.record.start + rig.record.over
    rig.s.moment[:] = 0.0
    rig.place()
    turn = rig.evaluate()[: rig.m, 0]
    expected = 0.3 * np.array([-np.sin(bearing), np.cos(bearing), 0.0]) if d == 3 else [0.3]
    np.testing.assert_allclose(turn, expected, atol=1e-12)


@pytest.mark.parametrize("d", [2, 3])
def test_the_decrease_supplies_what_the_energy_of_a_riser_at_rest_gains(d):
    rig = stirred_rig(FadingMoment, d)
    rig.s.v[:], rig.s.moment[:] = 0.0, 0.0
    start, over = rig.record.start, rig.record.over
    points, weights = leggauss(20)

    def supplied(share):
        rig.s.clock[0] = start + share * over
        rig.place()
        rig.evaluate()
        return rig.flow()[1]

    def stored(share):
        rig.s.clock[0] = start + share * over
        rig.place()
        rig.evaluate()
        return energies(rig.model.programs, rig.model.state)[0]

    work = 0.5 * over * weights @ [supplied(0.5 + 0.5 * x) for x in points]
    assert stored(1.0) - stored(0.0) == pytest.approx(work, rel=1e-9)
