"""Cylinder: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case, cylinders

from riserstudy.effects.cylinder import Upright


def upright(record, s):
    force = np.zeros_like(s.force)
    force[-1, record.node] = s.pull.sum()
    reach = s.platform[0, 2] - s.r[-1, record.node] + record.zero
    rate = s.platform[1, 2] - s.v[-1, record.node] + 0.0 * record.zero
    return {"force": force, "reach": reach, "reach_rate": rate}


CASES = {Upright: Case(cylinders)}

PLAIN = {Upright: [("drive device", upright)]}
