"""Fading moment: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import along, angles
from surroundings import Case, pipe

from riserstudy.effects.fading_moment import FadingMoment


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
