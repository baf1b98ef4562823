"""Inertia: a case, and the plain version."""

from __future__ import annotations

from plain import spread
from surroundings import SEGMENTS, Case

from riserstudy.effects.inertia import Inertia


def inertia(record, s):
    return {"force": -spread(record.mass, s.a)}


CASES = {
    Inertia: Case(lambda d: Inertia(9e3 * SEGMENTS, -9e3 * SEGMENTS)),
}

PLAIN = {
    Inertia: [("string_inertia", inertia)],
}
