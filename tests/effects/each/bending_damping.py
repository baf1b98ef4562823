"""Bending damping: a case, the plain version, and a mass that swings on a cantilever."""

from __future__ import annotations

import math

import numpy as np
from plain import along
from small_scenes import after_a_step, simulated
from surroundings import MOMENTS, Case, N, nodes, pipe

from riserstudy.effects.bending_damping import BendingDamping

STIFFNESS = 3.0 * 300e6 / 50.0**3  # of the cantilever at its end (N/m)
PERIOD = 2.0 * math.pi * math.sqrt(20e3 / STIFFNESS)
SCENE = f"""\
title: mass on a cantilever without mass
water: {{density: 1000 kg/m^3, surface: 50 m, seabed: 0 m}}
riser:
  - name: beam
    length: 50 m
    axial_stiffness: 10 GN
    bending_stiffness: 300 MN*m^2
    submerged_weight: 0 N/m
    drag: {{coefficient: 1e-4, diameter: 0.5 m}}
    structural_damping: {{ratio: 0.1, at_period: {PERIOD!r} s}}
bottom: {{hold: wellhead, elevation: 0 m, rotation: fixed}}
top: {{x: free, z: free, rotation: free, body: {{name: mass, mass: 20 t}}}}
current: {{profile: [{{elevation: 0 m, speed: 1 m/s}}, {{elevation: 50 m, speed: 1 m/s}}], beyond: hold}}
analysis:
  start: undeflected
  duration: {3.0 * PERIOD!r} s
  output: {{interval: {0.1 * PERIOD!r} s}}
  mesh: {{elements: 30}}
  newton_tolerance: 1e-12
  step: {PERIOD / 1600.0!r} s
  method: {{beta: 0.25, gamma: 0.5}}
"""


def bending_damping(record, s):
    length, t = along(s)
    if len(t) == 3:
        swing = np.cross(t, np.diff(s.v, axis=1), axis=0) / length
    else:
        dv = np.diff(s.v, axis=1)
        swing = ((t[1] * dv[0] - t[0] * dv[1]) / length)[None, :]
    rate = nodes(swing)
    for node, sign, held in ((0, -1.0, record.lower), (-1, 1.0, record.upper)):
        turning = np.cross(held[0], held[1])
        rate[:, node] += sign * (turning if len(t) == 3 else turning[1:2])
    return {"turn": record.time * rate}


def damped(d):
    draw = np.random.default_rng(4)
    time = draw.uniform(0.1, 0.4, N + 1)
    return BendingDamping(time, *draw.normal(0.0, 0.5, (2, 3, 3)), *np.zeros((2, MOMENTS[d], N + 1)))


CASES = {BendingDamping: Case(damped, lambda d: [pipe(d)], (2, 3))}

PLAIN = {BendingDamping: [("turn", bending_damping)]}

# without a load, in a plane on n segments
UNLOADED = {
    "bending damping": lambda n: BendingDamping(
        np.zeros(n + 1), *np.zeros((2, 3, 3)), *np.zeros((2, 1, n + 1))
    )
}


def test_a_mass_on_a_cantilever_swings_with_the_ratio_that_its_damping_has_at_its_period(tmp_path):
    found = simulated(tmp_path, SCENE)
    at_rest = 0.5 * 1000.0 * 1e-4 * 0.5 * 50.0**4 / (8.0 * 300e6)  # 7e-5 m, too little to change the drag
    aside = found["x"].isel(s=-1).values / at_rest
    expected = after_a_step(found["time"].values, 2.0 * np.pi / PERIOD, 0.1)
    # 30 segments, of second order; the load jumps, which costs half a step
    np.testing.assert_allclose(aside, expected, atol=3e-3)
