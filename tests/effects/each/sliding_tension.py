"""Sliding tension: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import along
from surroundings import L0, Case, N, nodes

from riserstudy.effects.sliding_tension import SlidingTension


def sliding_tension(record, s):
    length, tangent = along(s)
    pulls = np.zeros(len(length))
    own = length[record.segment]
    beyond = own - np.clip(own, record.shortest, record.longest)
    pulls[record.segment] = record.tension + record.stiffness * beyond
    return {"force": nodes(pulls * tangent)}


CASES = {SlidingTension: Case(lambda d: SlidingTension(N - 1, 2e6, L0[-1] - 1.0, 1.0, 3e6))}

PLAIN = {SlidingTension: [("string", sliding_tension)]}
