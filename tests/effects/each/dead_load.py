"""Dead load: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case

from riserstudy.effects.dead_load import DeadLoad


def pull(record, s):
    out = np.zeros_like(s.force)
    out[:, record.node] = record.load
    return {"force": out}


CASES = {DeadLoad: Case(lambda d: DeadLoad(2, np.linspace(3e5, 2e6, d)))}

PLAIN = {DeadLoad: [("device", pull)]}

# without a load, in a plane on n segments
UNLOADED = {"lateral force": lambda n: DeadLoad(n, np.zeros(2))}
