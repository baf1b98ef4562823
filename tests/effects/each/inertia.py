"""Inertia: a case, the plain version, and a standing wave on a string.

tests/verification/test_consistency_with_closed_forms.py has the frequencies of beams and bars.
"""

from __future__ import annotations

import numpy as np
from plain import spread
from small_scenes import simulated
from surroundings import SEGMENTS, Case

from riserstudy.effects.inertia import Inertia

SCENE = """\
title: string on a surging platform
riser: [{name: string, length: 100 m, axial_stiffness: 1e11 N, mass: 400 kg/m}]
bottom: {hold: wellhead, elevation: 0 m}
top: {x: platform, z: free, tension: 2 MN}
platform: {surge: {amplitude: 0.1 m, period: 6 s, ramp: 180 s}}
analysis:
  duration: 210 s
  output: {interval: 0.25 s, start: 192 s}
  mesh: {elements: 20}
  step: 0.05 s
"""


def inertia(record, s):
    return {"force": -spread(record.mass, s.a)}


CASES = {Inertia: Case(lambda d: Inertia(9e3 * SEGMENTS, -9e3 * SEGMENTS))}

PLAIN = {Inertia: [("string_inertia", inertia)]}

# without a load, in a plane on n segments
UNLOADED = {"inertia": lambda n: Inertia(np.zeros(n), np.zeros(n))}


def test_a_string_on_a_surging_platform_takes_the_shape_of_a_standing_wave(tmp_path):
    """x = A sin(k s) / sin(k L), k = omega sqrt(m / T): in the middle 0.68 A instead of half."""
    found = simulated(tmp_path, SCENE)
    k = 2.0 * np.pi / 6.0 * np.sqrt(400.0 / 2e6)
    shape = np.sin(k * found["s"].values) / np.sin(100.0 * k)
    expected = np.outer(found["x"].isel(s=-1), shape)
    # both ends of the ramp leave a little of the free vibration
    np.testing.assert_allclose(found["x"].transpose("time", "s"), expected, atol=5e-4 * 0.1)
