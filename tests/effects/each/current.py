"""Current: a case, the plain version, and a string in a sheared current."""

from __future__ import annotations

import numpy as np
from small_scenes import simulated
from surroundings import Case, sheared

from riserstudy.effects.current import Current

SCENE = """\
title: string in a current
water: {density: 1000 kg/m^3, surface: 100 m, seabed: 0 m}
riser:
  - name: string
    length: 100 m
    axial_stiffness: 100 GN
    submerged_weight: 0 N/m
    drag: {coefficient: 1.0, diameter: 0.5 m}
bottom: {hold: wellhead, elevation: 0 m}
top: {x: held, z: free, tension: 1 MN}
current: {profile: [{elevation: 0 m, speed: 0 m/s}, {elevation: 100 m, speed: 0.5 m/s}], beyond: hold}
analysis: {mesh: {elements: 20}}
"""


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


def test_a_string_in_a_sheared_current_sags_by_the_square_of_the_speed(tmp_path):
    """T x'' = -q (s / L)^2, so that x = q L^2 (s / L - (s / L)^4) / (12 T), at slopes of 5e-4."""
    found = simulated(tmp_path, SCENE)
    load, share = 0.5 * 1000.0 * 0.5 * 0.5**2, found["s"].values / 100.0
    expected = load * 100.0**2 * (share - share**4) / (12.0 * 1e6)
    # a strain of 1e-5, and 20 segments
    np.testing.assert_allclose(found["x"], expected, atol=1e-4 * expected.max())
