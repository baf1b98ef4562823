"""Soil: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case

from riserstudy.effects.soil import LinearSoil, SoftClay


def radial(s, node):
    """Horizontal distance of nodes and unit vectors away from where they stood."""
    aside = s.r[:-1, node]
    away = np.sqrt((aside**2).sum(axis=0))
    return away, aside / np.where(away > 0.0, away, 1.0)


def soft_clay(record, s):
    away, outwards = radial(s, record.node)
    q = away / record.y50
    line = 0.5 * np.cbrt(record.origin) * q / record.origin
    share = np.where(q <= record.origin, line, np.minimum(0.5 * np.cbrt(q), 1.0))
    out = np.zeros_like(s.force)
    out[:-1, record.node] = -record.ultimate * share * outwards
    return {"force": out}


def linear_soil(record, s):
    out = np.zeros_like(s.force)
    out[:-1, record.node] = -record.stiffness * s.r[:-1, record.node]
    return {"force": out}


CASES = {
    SoftClay: Case(
        lambda d: SoftClay(
            np.arange(5), 1e6 * np.linspace(1.0, 2.0, 5), np.array([9.0, 2.0, 1.0, 0.8, 0.9]), 0.1
        ),
        directions=(2, 3),
    ),
    LinearSoil: Case(
        lambda d: LinearSoil(np.arange(4), 1e6 * np.linspace(1.0, 2.0, 4)), directions=(2, 3)
    ),
}

PLAIN = {
    SoftClay: [("device", soft_clay)],
    LinearSoil: [("device", linear_soil)],
}
