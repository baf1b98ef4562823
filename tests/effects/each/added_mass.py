"""Added mass: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import across, axes, spread
from surroundings import SEGMENTS, Case

from riserstudy.effects.added_mass import AddedMass


def added_mass(record, s):
    return {"force": -spread(record.mass, across(s.a, axes(record, s)))}


CASES = {AddedMass: Case(lambda d: AddedMass(7e3 * SEGMENTS, -7e3 * SEGMENTS, 0))}

PLAIN = {AddedMass: [("string_inertia", added_mass)]}

# without a load, in a plane on n segments
UNLOADED = {"added mass": lambda n: AddedMass(np.zeros(n), np.zeros(n), 0)}
