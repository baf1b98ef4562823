"""End mass: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case, pair, uniform

from riserstudy.effects.end_mass import EndMass


def end_mass(record, s):
    i = record.node
    out = np.zeros_like(s.force)
    u = (s.water - s.v)[:-1, i]
    out[:-1, i] = record.drag[0] * np.sqrt((u**2).sum()) * u
    out[-1, i] = -record.weight - record.drag[1] * abs(s.v[-1, i]) * s.v[-1, i]
    return {"force": out}


def end_mass_inertia(record, s):
    out = np.zeros_like(s.force)
    out[:, record.node] = -record.mass * s.a[:, record.node]
    return {"force": out}


CASES = {
    EndMass: Case(
        lambda d: EndMass(0, 1.2e6, 1.4e5 * np.linspace(1.1, 1.0, d), pair(3e3, 7e3)), lambda d: [uniform(d)]
    )
}

PLAIN = {EndMass: [("device", end_mass), ("device_inertia", end_mass_inertia)]}

# without a load, in a plane on n segments
UNLOADED = {"end mass": lambda n: EndMass(n, 0.0, np.zeros(2), np.zeros(2))}
