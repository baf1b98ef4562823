"""Cylinder damping: a case, the plain version, and a mass that swings on cylinders."""

from __future__ import annotations

import numpy as np
from small_scenes import after_a_step, simulated
from surroundings import Case, cylinders, pair

from riserstudy.effects.cylinder_damping import CylinderDamping

SCENE = """\
title: mass on damped cylinders
riser: [{name: bar, length: 100 m, axial_stiffness: 20 MN}]
bottom: {hold: wellhead, elevation: 0 m}
top:
  z: free
  body: {name: ring, mass: 50 t}
  tensioners:
    count: 4
    linear: {tension: 25 kN, stiffness: 25 kN/m}
    damping: 5 kN*s/m
    mid_stroke: riser in equilibrium
analysis:
  start: unstretched
  duration: 10 s
  output: {interval: 0.1 s}
  mesh: {elements: 4}
  step: 0.01 s
  method: {beta: 0.25, gamma: 0.5}
"""


def cylinder_damping(record, s):
    return {"pull": record.damping * s.reach_rate}


CASES = {CylinderDamping: Case(lambda d: CylinderDamping(pair(967.0, 2e4)), lambda d: [cylinders(d)])}

PLAIN = {CylinderDamping: [("law", cylinder_damping)]}


def test_a_ring_on_cylinders_swings_with_their_damping_over_the_critical(tmp_path):
    """The bar is a spring of EA / L beside the cylinders; the ratio is c / (2 sqrt(k m))."""
    found = simulated(tmp_path, SCENE)
    stiffness = 20e6 / 100.0 + 4 * 25e3
    raised = found["z"].isel(s=-1).values - 100.0
    frequency, ratio = np.sqrt(stiffness / 50e3), 4 * 5e3 / (2.0 * np.sqrt(stiffness * 50e3))
    at_rest = 4 * 25e3 / (20e6 / 100.0)  # where the cylinders are at mid-stroke (m)
    expected = at_rest * after_a_step(found["time"].values, frequency, ratio)
    # 250 steps a period, of second order, over four periods
    np.testing.assert_allclose(raised, expected, atol=1e-3 * at_rest)
