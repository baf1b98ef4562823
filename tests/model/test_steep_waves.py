"""A regular wave that is higher than waves of its period can be has a warning, in deep and shallow water."""

import math

import numpy as np
import pytest

from riserstudy import load_scene
from riserstudy.model.warnings_of_scene import warnings_of
from riserstudy.records.warning import sentences

SCENE = """
title: a riser in a regular wave
gravity: {gravity!r} m/s^2
water: {{density: 1025 kg/m^3, surface: {depth!r} m, seabed: 0 m}}
riser:
  - {{name: pipe, length: {depth!r} m, outer_diameter: 0.5 m, axial_stiffness: 1 GN, mass: 500 kg/m,
     bending_stiffness: 100 MN*m^2, submerged_weight: 3000 N/m,
     drag: {{coefficient: 1.0, diameter: 0.5 m}}, added_mass: {{coefficient: 1.0, diameter: 0.5 m}}}}
bottom: {{hold: wellhead, elevation: 0 m, rotation: free}}
top: {{x: held, z: free, rotation: free, tension: 9 MN}}
analysis: {{duration: 60 s, output: {{interval: 1 s}}}}
"""


def number_of(period, depth, gravity):
    """Wave number (rad/m) by bisection."""
    low, high = 0.0, 1e3
    for _ in range(200):
        k = 0.5 * (low + high)
        below = gravity * k * math.tanh(k * depth) < (2.0 * math.pi / period) ** 2
        low, high = (k, high) if below else (low, k)
    return low


@pytest.mark.parametrize("seed", range(12))
def test_a_wave_above_the_breaking_height_has_a_warning(tmp_path, seed):
    """By its height or amplitude, in the sea of the scene or in that of the platform's response alone."""
    draw = np.random.default_rng(seed)
    depth = float(np.exp(draw.uniform(math.log(8.0), math.log(2000.0))))
    gravity, period = float(draw.uniform(9.5, 10.0)), float(draw.uniform(4.0, 18.0))
    path = tmp_path / "scene.yaml"
    path.write_text(SCENE.format(depth=depth, gravity=gravity))
    k = number_of(period, depth, gravity)
    highest = 0.142 * 2.0 * math.pi / k * math.tanh(k * depth)
    for share, breaks in ((0.999, False), (1.001, True)):
        height = share * highest
        size = {"height": f"{height!r} m"} if seed % 2 else {"amplitude": f"{0.5 * height!r} m"}
        wave = size | {"period": f"{period!r} s"}
        of_scene = {"wave": wave | {"above_mean_level": "none", "ramp": "9 s"}}
        rows = [{"period": f"{t} s", "heave": "1 m/m", "heave_phase": "0 deg"} for t in (3, 30)]
        response = {"operators": rows, "phases": "lead", "wave": wave, "ramp": "9 s"}
        alone = {"platform": {"response": response}, "top.z": "platform", "top.tension": None,
                 "top.elevation": f"{depth!r} m"}  # fmt: skip
        for place, changes in (("wave", of_scene), ("platform.response.wave", alone)):
            said = [w for w in sentences(warnings_of(load_scene(path, **changes).resolved())) if "break" in w]
            assert len(said) == breaks
            assert not breaks or said[0].startswith(f"{place}: a height of {height:.3g} m")
