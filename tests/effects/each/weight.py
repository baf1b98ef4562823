"""Weight: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case, N

from riserstudy.effects.weight import Weight


def weight(record, s):
    out = np.zeros_like(s.force)
    out[record.direction] = record.load
    return {"force": out}


CASES = {Weight: Case(lambda d: Weight(d - 1, -1e4 * np.linspace(1.0, 2.0, N + 1)))}

PLAIN = {Weight: [("string", weight)]}

# without a load, in a plane on n segments
UNLOADED = {"weight": lambda n: Weight(1, np.zeros(n + 1))}
