"""Wave force: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import across, at_nodes, spread
from surroundings import SEGMENTS, Case, N, sea

from riserstudy.effects.wave import CONSTANT
from riserstudy.effects.wave_force import WaveForce


def wave_force(record, s):
    return {"force": spread(record.mass, across(s.water_rate, at_nodes(s)))}


CASES = {
    WaveForce: Case(lambda d: WaveForce(8e3 * SEGMENTS, np.zeros((d, N + 1))), lambda d: [sea(d, CONSTANT)])
}

PLAIN = {WaveForce: [("string", wave_force)]}

# without a load, in a plane on n segments
UNLOADED = {"wave force": lambda n: WaveForce(np.zeros(n), np.zeros((2, n + 1)))}
