"""A model at rest that several runs start from is the same for each of them, and stays at rest."""

import numpy as np
import pytest

from riserstudy.model.mesh import prescribed
from riserstudy.simulation.rest import Rest
from riserstudy.simulation.run import march, single

SPATIAL = """\
title: a riser in two currents, swayed
gravity: 9.81 m/s^2
water: {density: 1025 kg/m^3, surface: 110 m, seabed: 0 m}
riser:
  - name: riser
    length: 100 m
    outer_diameter: 0.5334 m
    inner_diameter: 0.4826 m
    young_modulus: 206 GPa
    mass: 600 kg/m
    submerged_weight: 2 kN/m
    contents: {density: 1400 kg/m^3}
    drag: {coefficient: 1.0, diameter: 1 m}
    added_mass: {coefficient: 1.0, diameter: 1 m}
bottom: {hold: wellhead, elevation: 5 m, rotation: {stiffness: 60 kN*m/deg}, body: {name: LMRP, mass: 9 t}}
top: {x: platform, z: free, tension: 900 kN}
platform: {surge: {amplitude: 1 m, period: 8 s, ramp: 2 s}, sway: {amplitude: 2 m, period: 6 s, ramp: 2 s}}
current: {heading: 40 deg, profile: {shape: uniform, surface_speed: 0.8 m/s}}
EVENT
analysis: {duration: 6 s, output: {interval: 0.25 s}}
"""
EVENT = "disconnect: {at: 2 s, over: 0.5 s, drain: {friction: 0.02}, stack: {stiffness: 50 MN/m}}"


@pytest.fixture(params=["", EVENT], ids=["connected", "let go"])
def scene(request, scene_of):
    return scene_of(SPATIAL.replace("EVENT", request.param)).resolved()


def test_the_second_run_from_a_rest_is_that_of_a_new_model_to_the_last_bit(scene):
    mesh = prescribed(scene, 16)
    rest = Rest(scene, mesh)
    march(scene, mesh, 0.1, rest=rest)  # writes all that a run writes
    assert rest.again(mesh)
    assert not rest.again(prescribed(scene, 16))
    again, fresh = march(scene, mesh, 0.05, rest=rest), march(scene, mesh, 0.05)
    assert set(again.arrays) == set(fresh.arrays)
    for name, values in fresh.arrays.items():
        np.testing.assert_array_equal(again.arrays[name], values, err_msg=name)


def test_what_is_told_of_rest_is_not_told_of_the_last_moment_of_the_run(scene):
    mesh = prescribed(scene, 16)
    still = scene.analysis.replaced(duration=None, output=None)
    resting = scene.replaced(analysis=still, disconnect=None)
    moved, rest = single(scene, mesh, 0.1, everywhere=True), single(resting, mesh, None)
    for name in ("shear_force_static", "bending_moment_static", "effective_tension_static"):
        np.testing.assert_allclose(moved.arrays[name], rest.arrays[name], rtol=1e-9, atol=1e-6, err_msg=name)
