"""Axial damping: a case, the plain version, and a mass that swings on a bar."""

from __future__ import annotations

import math

import numpy as np
from plain import along
from small_scenes import after_a_step, simulated
from surroundings import SEGMENTS, Case, nodes

from riserstudy.effects.axial_damping import AxialDamping

PERIOD = 2.0 * math.pi * math.sqrt(100.0 * 50e3 / 2e7)  # of the mass on the bar (s)
SCENE = f"""\
title: mass on a bar without mass
riser:
  - name: bar
    length: 100 m
    axial_stiffness: 20 MN
    structural_damping: {{ratio: 0.1, at_period: {PERIOD!r} s}}
bottom: {{hold: wellhead, elevation: 0 m}}
top: {{z: free, tension: 100 kN, body: {{name: mass, mass: 50 t}}}}
analysis:
  start: unstretched
  duration: 10 s
  output: {{interval: 0.1 s}}
  mesh: {{elements: 4}}
  step: 0.01 s
  method: {{beta: 0.25, gamma: 0.5}}
"""


def axial_damping(record, s):
    _, tangent = along(s)
    rate = (np.diff(s.v, axis=1) * tangent).sum(axis=0)
    return {"force": nodes(record.damping * rate * tangent)}


CASES = {AxialDamping: Case(lambda d: AxialDamping(3e6 * SEGMENTS))}

PLAIN = {AxialDamping: [("string", axial_damping)]}

# without a load, in a plane on n segments
UNLOADED = {"axial damping": lambda n: AxialDamping(np.zeros(n))}


def test_a_mass_on_a_bar_swings_with_the_ratio_that_its_damping_has_at_its_period(tmp_path):
    found = simulated(tmp_path, SCENE)
    raised = found["z"].isel(s=-1).values - 100.0
    expected = 0.5 * after_a_step(found["time"].values, 2.0 * np.pi / PERIOD, 0.1)
    # the step is a hundredth of a radian: its square, over five periods
    np.testing.assert_allclose(raised, expected, atol=5e-4)
