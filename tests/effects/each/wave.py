"""Wave: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case, sea

from riserstudy.effects.wave import STRETCHED, Wave


def wave(record, s):
    """Velocity and acceleration of the water, component by component, from the potential's formulas."""
    t, d = s.clock[0], record.depth
    p = np.pi / record.ramp if t < record.ramp else 0.0
    grown, rate = (0.5 * (1 - np.cos(p * t)), 0.5 * p * np.sin(p * t)) if p else (1.0, 0.0)
    water, water_rate = np.zeros((2, *s.r.shape))
    for i in range(s.r.shape[1]):
        x = record.heading @ s.r[:-1, i]
        z = s.r[-1, i] - record.surface
        angle = record.number * x - record.frequency * t + record.phase
        eta = grown * (record.amplitude * np.cos(angle)).sum()
        if record.above == STRETCHED:
            z = (min(z, eta) + d) * d / (d + eta) - d
        z = min(z, 0.0)
        speed, kd = record.amplitude * record.frequency, record.number * d
        u = speed * np.cosh(record.number * (z + d)) / np.sinh(kd)
        w = speed * np.sinh(record.number * (z + d)) / np.sinh(kd)
        water[:-1, i] = record.heading * grown * (u * np.cos(angle)).sum()
        water[-1, i] = grown * (w * np.sin(angle)).sum()
        f = record.frequency
        along = (u * (grown * f * np.sin(angle) + rate * np.cos(angle))).sum()
        water_rate[:-1, i] = record.heading * along
        water_rate[-1, i] = (w * (rate * np.sin(angle) - grown * f * np.cos(angle))).sum()
    return {"water": water, "water_rate": water_rate}


CASES = {Wave: Case(sea)}

PLAIN = {Wave: [("drive", wave)]}
