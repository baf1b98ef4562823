"""Current: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from surroundings import Case, sheared

from riserstudy.effects.current import Current


def current(record, s):
    share = s.clock[1] * min(1.0, s.clock[0] / record.ramp if record.ramp else 1.0)
    speed = np.interp(s.r[-1], record.elevation, record.speed)
    out = np.zeros_like(s.water)
    out[:-1] = share * record.heading[:, None] * speed
    return {"water": out}


CASES = {Current: Case(sheared)}

PLAIN = {Current: [("drive", current)]}

# without a load, in a plane on n segments
UNLOADED = {
    "current": lambda n: Current(
        np.array([0.0, 533.0]), np.zeros(2), np.array([1.0]), np.zeros(n + 1, np.int64), 0.0
    )
}
