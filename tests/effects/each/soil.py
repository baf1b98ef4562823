"""Soil: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import PchipInterpolator
from surroundings import Case

from riserstudy.effects.soil import LinearSoil, SoftClay, TabulatedSprings


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


def tabulated(record, s):
    """By numpy's polynomials, piece by piece."""
    away, outwards = radial(s, record.node)
    out = np.zeros_like(s.force)
    for k, (y, way) in enumerate(zip(away, outwards.T, strict=True)):
        places = record.places[k]
        piece = int(np.clip(np.searchsorted(places, y, "right") - 1, 0, len(places) - 2))
        p = np.polyval(record.force[:, k, piece], min(y, places[-1]) - places[piece])
        out[:-1, record.node[k]] = -p * way
    return {"force": out}


def springs(_):
    """Two pieces each, rising with a continuous slope, constant from the last place on."""
    places = np.array([9.0, 2.0, 1.0, 0.8, 0.9])[:, None] * np.array([0.0, 0.3, 2.5])
    most = 1e6 * np.linspace(1.0, 2.0, 5)
    curves = [PchipInterpolator(y, [0.0, 0.4 * p, p]) for y, p in zip(places, most, strict=True)]
    energies = [curve.antiderivative() for curve in curves]
    return TabulatedSprings(
        np.arange(5),
        places,
        np.stack([c.c for c in curves], axis=1),
        np.stack([e.c for e in energies], axis=1),
    )


CASES = {
    TabulatedSprings: Case(springs, directions=(2, 3)),
    SoftClay: Case(
        lambda d: SoftClay(
            np.arange(5), 1e6 * np.linspace(1.0, 2.0, 5), np.array([9.0, 2.0, 1.0, 0.8, 0.9]), 0.1
        ),
        directions=(2, 3),
    ),
    LinearSoil: Case(lambda d: LinearSoil(np.arange(4), 1e6 * np.linspace(1.0, 2.0, 4)), directions=(2, 3)),
}

PLAIN = {
    TabulatedSprings: [("device", tabulated)],
    SoftClay: [("device", soft_clay)],
    LinearSoil: [("device", linear_soil)],
}
