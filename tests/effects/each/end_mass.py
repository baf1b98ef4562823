"""End mass: a case, the plain version, and a body on a spring and on a string.

tests/verification/test_consistency_with_pendulums.py has bodies with a lever arm.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq
from small_scenes import after_a_step, simulated
from surroundings import Case, pair, uniform

from riserstudy import load_scene, modes
from riserstudy.effects.end_mass import EndMass

SPRING = """\
title: mass on a bar without mass
water: {density: 1000 kg/m^3}
riser: [{name: bar, length: 100 m, axial_stiffness: 20 MN, submerged_weight: 0 N/m}]
bottom: {hold: wellhead, elevation: 0 m}
top:
  z: free
  tension: 100 kN
  body: {name: mass, mass: 30 t, added_mass: {vertical: 20 t}, drag_area: {vertical: 40 m^2}}
analysis:
  start: unstretched
  duration: 10 s
  output: {interval: 0.01 s}
  mesh: {elements: 4}
  step: 0.01 s
  method: {beta: 0.25, gamma: 0.5}
"""
HANGING = """\
title: body on a string in a current
water: {density: 1000 kg/m^3, surface: 150 m, seabed: 0 m}
riser:
  - name: string
    length: 100 m
    axial_stiffness: 1e12 N
    submerged_weight: 0 N/m
    drag: {coefficient: 0, diameter: 0.1 m}
bottom:
  hold: free
  body: {name: body, mass: 20 t, submerged_weight: 100 kN, drag_area: {horizontal: 40 m^2}}
top: {x: held, z: held, elevation: 150 m}
current: {profile: [{elevation: 0 m, speed: 2 m/s}, {elevation: 200 m, speed: 2 m/s}]}
analysis: {mesh: {elements: 5}}
"""


def end_mass(record, s):
    i = record.node
    out = np.zeros_like(s.force)
    u = (s.water - s.v)[:-1, i]
    out[:-1, i] = record.drag[0] * np.sqrt((u**2).sum()) * u
    rise = s.water[-1, i] - s.v[-1, i]
    out[-1, i] = -record.weight + record.drag[1] * abs(rise) * rise
    out[:, i] += record.displaced * s.water_rate[:, i]
    return {"force": out}


def end_mass_inertia(record, s):
    out = np.zeros_like(s.force)
    out[:, record.node] = -record.mass * s.a[:, record.node]
    return {"force": out}


CASES = {
    EndMass: Case(
        lambda d: EndMass(
            0, 1.2e6, 1.4e5 * np.linspace(1.1, 1.0, d), pair(3e3, 7e3), 2e4 * np.linspace(1.5, 1.0, d)
        ),
        lambda d: [uniform(d)],
    )
}

PLAIN = {EndMass: [("device", end_mass), ("device_inertia", end_mass_inertia)]}

# without a load, in a plane on n segments
UNLOADED = {"end mass": lambda n: EndMass(n, 0.0, *np.zeros((3, 2)))}


def test_the_mass_with_its_added_mass_swings_on_a_spring(tmp_path):
    """Without drag, T / k (1 - cos(omega t)), omega^2 = k / m."""
    found = simulated(tmp_path, SPRING, {"top.body.drag_area": None})
    raised = found["z"].isel(s=-1).values - 100.0
    expected = 0.5 * after_a_step(found["time"].values, np.sqrt(200e3 / 50e3), 0.0)
    # the step is 0.02 of a radian: a 24th of its square, over 20 radians
    np.testing.assert_allclose(raised, expected, atol=1e-3 * 0.5)


def test_quadratic_drag_takes_from_each_swing_what_its_first_integral_has(tmp_path):
    """With b = 2 c / m, from one extreme to the next: (1 - b A_1) exp(b A_1) = (1 + b A_0) exp(-b A_0)."""
    found = simulated(tmp_path, SPRING)
    about = found["z"].isel(s=-1).values - 100.5
    extremes = np.abs(about[1:-1][np.diff(about)[1:] * np.diff(about)[:-1] < 0.0])
    b, amplitude, expected = 2.0 * 0.5 * 1000.0 * 40.0 / 50e3, 0.5, []
    for _ in extremes:
        kept = (1.0 + b * amplitude) * np.exp(-b * amplitude)
        amplitude = brentq(lambda a, kept=kept: (1.0 - b * a) * np.exp(b * a) - kept, 0.0, amplitude)
        expected.append(amplitude)
    assert len(expected) == 6
    # an output within 0.005 s of an extreme misses 5e-5 of it
    np.testing.assert_allclose(extremes, expected, rtol=2e-4)


def test_a_body_on_a_string_hangs_along_its_weight_and_drag(tmp_path):
    found = simulated(tmp_path, HANGING)
    drag, weight = 0.5 * 1000.0 * 40.0 * 2.0**2, 100e3
    force, above = np.hypot(drag, weight), 100.0 - found["s"].values
    np.testing.assert_allclose(found["x"], above * drag / force, atol=1e-4)
    np.testing.assert_allclose(found["z"], 150.0 - above * weight / force, atol=1e-4)
    np.testing.assert_allclose(found["effective_tension"], force, rtol=1e-6)


def test_modes_of_a_mass_on_a_massless_spring_are_those_of_the_oscillator(tmp_path):
    file = tmp_path / "scene.yaml"
    file.write_text(SPRING)
    one = {"analysis.mesh.elements": 1}
    found = modes(load_scene(file, **one), 3)
    assert np.isnan(found["frequency_error"].values).all()  # finer meshes have nodes without mass
    assert found["frequency"].values == pytest.approx([np.sqrt(200e3 / 50e3) / (2 * np.pi)])
