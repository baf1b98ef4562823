"""Linear spring: a case, the plain version, a hanging string, and a body that oscillates."""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, energy, motion, on_two_cylinders
from surroundings import Case, cylinders, pair

from riserstudy import simulate
from riserstudy.effects.linear_spring import LinearSpring


def linear_spring(record, s):
    return {"pull": record.tension + record.stiffness * s.reach}


CASES = {LinearSpring: Case(lambda d: LinearSpring(pair(8e5, 7e5), pair(3e4, 2e4)), lambda d: [cylinders(d)])}

PLAIN = {LinearSpring: [("law", linear_spring)]}


SCENE = """\
title: string on springs
water: {density: 1025 kg/m^3}
riser: [{name: string, length: 100 m, axial_stiffness: 1 TN, mass: 500 kg/m, submerged_weight: 8 kN/m}]
bottom: {hold: free}
top:
  z: free
  tensioners:
    {count: 4, mid_stroke: riser unstretched, linear: {tension: 170 kN, stiffness: 12 kN/m}}
platform: {position: {heave: 1.5 m}}
analysis: {mesh: {elements: 10}}
"""


def test_the_weight_that_hangs_on_springs_extends_them(scene_of):
    """Each carries a quarter of 800 kN, wherever the platform is."""
    found = simulate(scene_of(SCENE))
    np.testing.assert_allclose(found["tensioner_force_static"], 200e3, rtol=1e-9)
    extension = 30.0 / 12.0
    np.testing.assert_allclose(found["tensioner_stroke_static"], extension, rtol=1e-9)
    # elevations count from the top of the unstretched riser; it stretches by 4e-5 m
    assert float(found["z"][-1]) == pytest.approx(1.5 - extension, abs=1e-3)


def test_a_body_on_springs_is_an_oscillator():
    mass, stiff = 2e4, pair(3e4, 5e4)
    records = LinearSpring(np.zeros(2), stiff), on_two_cylinders()
    model = bodies(*records, mass=mass, cylinders=2)
    model.s.v[-1, UPPER] = 1.0
    w = np.sqrt(stiff.sum() / mass)
    found = motion(model, 5.0 * np.pi / w, 1000)  # two periods and a half
    expected = np.sin(w * found.time) / w
    # 400 steps a period: the trapezoidal rule delays by 2e-5 of the phase, 16 rad
    np.testing.assert_allclose(found.place[:, -1, UPPER] - 1.0, expected, atol=1e-3 / w)
    assert energy(model) == pytest.approx(0.5 * mass, rel=1e-5)


def test_a_stretched_spring_has_the_energy_that_stretched_it():
    """Half of stiffness times square of the extension, and the work of the tension at mid-stroke."""
    records = LinearSpring(pair(1e5, 2e5), pair(3e4, 5e4)), on_two_cylinders()
    model = bodies(*records, cylinders=2)
    still = energy(model)
    model.s.r[-1, UPPER] = 1.0 - 2.0
    assert energy(model) - still == pytest.approx(2.0 * 3e5 + 0.5 * 8e4 * 2.0**2, rel=1e-12)
