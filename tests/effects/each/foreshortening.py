"""Foreshortening: a case, and the plain version."""

from __future__ import annotations

from plain import along
from surroundings import L0, Case, nodes, pipe

from riserstudy.effects.foreshortening import Foreshortening


def foreshortening(record, s):
    low, up = s.moment[:, :-1], s.moment[:, 1:]
    _, tangent = along(s)
    squares = (low**2 + low * up + up**2).sum(axis=0)
    return {"force": nodes(record.slope * squares * tangent)}


CASES = {
    Foreshortening: Case(
        lambda d: Foreshortening(8e9 * (L0 / 2.7e8) ** 2 / 72.0), lambda d: [pipe(d)], (2, 3)
    )
}

PLAIN = {Foreshortening: [("string", foreshortening)]}
