"""A straight riser that moves along itself in still water: how it bounces, and its tension."""

import json

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from riserstudy import load_scene, simulate
from riserstudy.errors import InputError

LENGTH, WEIGHT, MASS = 200.0, 2.0e3, 300.0  # m, N/m, kg/m
SPRING = 2e4  # N/m, of the tensioner
DRAG = 0.5 * 1025.0 * 0.05 * np.pi * 0.5  # N s2/m3, of the riser below

SCENE = """\
title: riser that moves along itself
water: {density: 1025 kg/m^3}
riser:
  - name: riser
    length: 200 m
    axial_stiffness: 1e10 N
    mass: 300 kg/m
    submerged_weight: 2 kN/m
    tangential_drag: {coefficient: 0.05, diameter: 0.5 m}
    structural_damping: {ratio: 0.002, at_period: 10 s}
bottom: {hold: free}
"""
BOUNCING = """\
top:
  z: free
  tensioners:
    {count: 1, mid_stroke: riser unstretched, linear: {tension: 400 kN, stiffness: 20 kN/m}}
platform: {heave: {amplitude: 3 m, period: 10 s, ramp: 10 s}}
analysis: {duration: 60 s, output: {interval: 0.25 s}, mesh: {elements: 8}, step: 0.05 s}
"""
HEAVING = """\
top: {z: platform, elevation: 0 m}
platform: {heave: {amplitude: 3 m, period: 10 s, ramp: 10 s}}
analysis: {duration: 30 s, output: {start: 20 s, interval: 0.1 s}, mesh: {elements: 8}, step: 0.025 s}
"""


def run(tmp_path, text, **changes):
    file = tmp_path / "scene.yaml"
    file.write_text(SCENE + text)
    return simulate(load_scene(file, **changes))


def test_on_a_spring_near_resonance_the_riser_bounces_as_far_as_drag_lets_it(tmp_path):
    """m L v' = k (p - x) - c L |v| v with the platform's heave p, as one body; 11 s against 10 s."""
    found = run(tmp_path, BOUNCING)
    time = found["time"].values

    def rate(t, state, drag=DRAG):
        x, v = state
        ramp = 0.5 * (1.0 - np.cos(np.pi * min(t, 10.0) / 10.0))
        spring = SPRING * (3.0 * ramp * np.sin(0.2 * np.pi * t) - x)
        return [v, (spring - drag * LENGTH * abs(v) * v) / (MASS * LENGTH)]

    span = (0.0, time[-1])
    exact = solve_ivp(rate, span, [0.0, 0.0], t_eval=time, rtol=1e-9, atol=1e-9).y[0]
    free = solve_ivp(rate, span, [0.0, 0.0], t_eval=time, rtol=1e-9, args=(0.0,)).y[0]
    assert np.abs(free).max() > 2.0 * np.abs(exact).max()  # it is drag that holds it
    place = found["z"].mean("s").values
    np.testing.assert_allclose(place - place[0], exact, atol=1e-3 * np.abs(exact).max())


def test_the_top_tension_in_heave_is_weight_inertia_and_drag(tmp_path):
    """A riser as stiff as this one moves as a whole: waves run along it in 0.035 s."""
    found = run(tmp_path, HEAVING)
    w = 2.0 * np.pi / 10.0
    t = found["time"].values
    speed, rate = 3.0 * w * np.cos(w * t), -3.0 * w**2 * np.sin(w * t)
    load = WEIGHT + MASS * rate + DRAG * np.abs(speed) * speed
    tension = found["effective_tension"]
    for s in (100.0, 200.0):
        np.testing.assert_allclose(
            tension.sel(s=s), load * s, atol=1e-3 * np.abs(load * s - WEIGHT * s).max()
        )


def test_the_balance_of_energy_knows_it(tmp_path):
    found = run(tmp_path, HEAVING)
    assert json.loads(found.attrs["audit"])["unexplained_share"] < 1e-4


def test_it_needs_water(tmp_path):
    with pytest.raises(InputError, match="requires water"):
        run(tmp_path, HEAVING, water=None)
