"""Tension loss: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case

from riserstudy.effects.tension_loss import TensionLoss


def tension_loss(record, s):
    gone = np.clip((s.clock[0] - record.start) / record.over, 0.0, 1.0)
    out = np.zeros_like(s.force)
    out[:, record.node] = record.load * np.sin(0.5 * np.pi * gone) ** 2
    return {"force": out}


CASES = {TensionLoss: Case(lambda d: TensionLoss(2, -np.linspace(3e5, 2e6, d), 2.0, 4.5))}

PLAIN = {TensionLoss: [("device", tension_loss)]}

# without a load, in a plane on n segments
UNLOADED = {"tension loss": lambda n: TensionLoss(n, np.zeros(2), 1.0, 1.0)}
