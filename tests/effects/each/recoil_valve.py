"""Recoil valve: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case, cylinders, pair

from riserstudy.effects.linear_spring import LinearSpring
from riserstudy.effects.recoil_valve import RecoilValve


def recoil_valve(record, s):
    """Half closed: the mean of what it is open and closed, at the state's own time."""
    gone = np.clip((s.clock[0] - record.start) / record.over, 0.0, 1.0)
    opening = 1.0 - (1.0 - record.residual) * np.sin(0.5 * np.pi * gone) ** 2
    drop = record.resistance * s.reach_rate * np.abs(s.reach_rate) / opening**2
    return {"pull": np.maximum(drop, -np.maximum(s.pull, 0.0))}


def _valve(d: int) -> RecoilValve:
    return RecoilValve(pair(2e4, 3e4), pair(0.3, 1.0), 2.0, 4.5, np.zeros(2))


CASES = {RecoilValve: Case(_valve, lambda d: [cylinders(d), LinearSpring(pair(1e6, 2e6), pair(1e5, 2e5))])}

PLAIN = {RecoilValve: [("law", recoil_valve)]}
