"""End stop: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case, cylinders, pair

from riserstudy.effects.end_stop import EndStop


def end_stop(record, s):
    above = np.maximum(s.reach - record.longest, 0.0)
    below = np.minimum(s.reach - record.shortest, 0.0)
    return {"pull": record.stiffness * (above + below)}


CASES = {
    EndStop: Case(
        lambda d: EndStop(pair(-0.1, 0.2), pair(0.1, 0.3), pair(1e7, 2e7)), lambda d: [cylinders(d)]
    )
}

PLAIN = {EndStop: [("law", end_stop)]}
