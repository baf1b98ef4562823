"""Inertia: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import spread
from surroundings import SEGMENTS, Case

from riserstudy.effects.inertia import Inertia


def inertia(record, s):
    return {"force": -spread(record.mass, s.a)}


CASES = {Inertia: Case(lambda d: Inertia(9e3 * SEGMENTS, -9e3 * SEGMENTS))}

PLAIN = {Inertia: [("string_inertia", inertia)]}

# without a load, in a plane on n segments
UNLOADED = {"inertia": lambda n: Inertia(np.zeros(n), np.zeros(n))}
