"""End stop: a case, the plain version, and a bar below cylinders at their stops."""

from __future__ import annotations

import numpy as np
import pytest
from small_scenes import simulated
from surroundings import Case, cylinders, pair

from riserstudy.effects.end_stop import EndStop

SCENE = """\
title: bar on cylinders at their stops
riser: [{name: bar, length: 100 m, axial_stiffness: 100 MN}]
bottom: {hold: wellhead, elevation: 0 m}
top:
  z: free
  tensioners:
    count: 4
    linear: {tension: 250 kN, stiffness: 50 kN/m}
    mid_stroke: riser in equilibrium
    stroke: {shortest: -1 m, longest: 1.5 m, stop_stiffness: 5 MN/m}
platform: {position: {heave: 2 m}}
analysis: {mesh: {elements: 5}}
"""


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


@pytest.mark.parametrize("heave, stop", [(3.0, 1.5), (-2.0, -1.0), (1.2, None)])
def test_beyond_a_stop_the_ring_hangs_on_two_springs_side_by_side(tmp_path, heave, stop):
    """Cylinders and stops pull against the bar: k r + k_s (r - stop) = K (heave - r)."""
    found = simulated(tmp_path, SCENE, {"platform.position.heave": f"{heave} m"})
    cylinders, stops, bar = 4 * 50e3, 4 * 5e6 if stop else 0.0, 100e6 / 100.0
    reach = (bar * heave + stops * (stop or 0.0)) / (cylinders + stops + bar)
    np.testing.assert_allclose(found["tensioner_stroke"], reach, rtol=1e-6)
    np.testing.assert_allclose(found["effective_tension"], 1e6 + bar * (heave - reach), rtol=1e-6)
