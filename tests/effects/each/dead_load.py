"""Dead load: a case, the plain version, and a string pulled aside."""

from __future__ import annotations

import numpy as np
from small_scenes import simulated
from surroundings import Case

from riserstudy.effects.dead_load import DeadLoad

SCENE = """\
title: string pulled aside
riser: [{name: string, length: 100 m, axial_stiffness: 100 MN}]
bottom: {hold: wellhead, elevation: 0 m}
top: {x: free, z: free, tension: 400 kN, lateral_force: 300 kN}
analysis: {mesh: {elements: 5}}
"""


def pull(record, s):
    out = np.zeros_like(s.force)
    out[:, record.node] = record.load
    return {"force": out}


CASES = {DeadLoad: Case(lambda d: DeadLoad(2, np.linspace(3e5, 2e6, d)))}

PLAIN = {DeadLoad: [("device", pull)]}

# without a load, in a plane on n segments
UNLOADED = {"lateral force": lambda n: DeadLoad(n, np.zeros(2))}


def test_a_string_without_weight_points_along_the_force_on_its_end(tmp_path):
    """A triangle of 3, 4 and 5: 500 kN along a string that stretches by 0.5 %."""
    found = simulated(tmp_path, SCENE)
    s = found["s"].values
    np.testing.assert_allclose(found["x"], 0.6 * 1.005 * s, rtol=1e-8, atol=1e-9)
    np.testing.assert_allclose(found["z"], 0.8 * 1.005 * s, rtol=1e-8, atol=1e-9)
    np.testing.assert_allclose(found["effective_tension"], 500e3, rtol=1e-8)
