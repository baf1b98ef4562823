"""A riser that leaves the water between two nodes: the loads of its wet part, whatever the mesh."""

import json

import numpy as np
import pytest

from riserstudy import load_scene, simulate

SCENE = """\
title: riser through the surface
gravity: 9.81 m/s^2
water: {{density: 1025 kg/m^3, seabed: 0 m, surface: {surface} m}}
riser:
  - name: riser
    length: 100 m
    axial_stiffness: 1e10 N
    mass: 500 kg/m
    submerged_weight: 0 N/m
    drag: {{coefficient: 1.0, diameter: 1 m}}
    added_mass: {{coefficient: 1.0, diameter: 1 m}}
bottom: {{hold: wellhead, elevation: 0 m}}
top: {{x: held, z: free, tension: 1 MN}}
"""
CURRENT = """\
current:
  profile: [{elevation: 0 m, speed: 0.1 m/s}, {elevation: 100 m, speed: 0.1 m/s}]
analysis: {mesh: {elements: 16}}
"""
WAVE = """\
wave: {height: 4 m, period: 8 s, ramp: 8 s, above_mean_level: %s}
analysis: {duration: 32 s, output: {start: 8 s, interval: 0.25 s}, mesh: {elements: 16}, step: 0.05 s}
"""


def run(tmp_path, text, surface, **overrides):
    file = tmp_path / "scene.yaml"
    file.write_text(SCENE.format(surface=surface) + text)
    return simulate(load_scene(file, **overrides))


@pytest.mark.parametrize("surface", [55.0, 60.0, 78.3])
def test_a_current_pushes_the_wet_part_alone(tmp_path, surface):
    """A taut string under 1/2 rho C_D D u^2 per length up to the surface is a parabola, then straight."""
    found = run(tmp_path, CURRENT, surface)
    load, tension, length = 0.5 * 1025.0 * 0.1**2, 1e6, 100.0
    s = found["s"].values
    low = load * surface * (1.0 - 0.5 * surface / length)  # force on the lower end
    above = np.maximum(s - surface, 0.0)
    expected = (low * s - 0.5 * load * s**2 + 0.5 * load * above**2) / tension
    # the load of a segment that is wet in part stands at its middle: 1/8 of its length squared at most
    coarse = 0.5 * load * 6.25**2 / 4.0 / tension
    np.testing.assert_allclose(found["x"], expected, atol=coarse + 1e-4 * expected.max())


@pytest.mark.parametrize("above", ["none", "constant", "stretched"])
def test_the_error_falls_with_the_square_of_the_segments(tmp_path, above):
    """At a station under water and over time, with the surface moving between the nodes."""
    history = {}
    for elements in (16, 32, 64, 128, 1024):
        mesh = {"analysis.mesh": {"elements": elements}, "analysis.output.stations": ["50 m"]}
        history[elements] = run(tmp_path, WAVE % above, 78.3, **mesh)["x"].values
    size = np.abs(history[1024]).max()
    error = {n: np.abs(h - history[1024]).max() / size for n, h in history.items() if n < 1024}
    order = np.polyfit(np.log(list(error)), np.log(list(error.values())), 1)[0]
    assert order < -1.7, error
    assert error[64] < 2e-3, error


def test_the_balance_of_energy_knows_the_waterline(tmp_path):
    found = run(tmp_path, WAVE % "stretched", 78.3, **{"analysis.mesh": {"elements": 64}})
    assert json.loads(found.attrs["audit"])["unexplained_share"] < 1e-3


@pytest.mark.long
def test_a_coefficient_by_a_table_counts_in_the_water_alone_too(tmp_path):
    table = [{"elevation": f"{z} m", "value": 1.0} for z in (0, 40)]
    plain, tabulated = (
        run(tmp_path, CURRENT, 78.3, **sets) for sets in ({}, {"riser[0].drag.coefficient": table})
    )
    np.testing.assert_allclose(tabulated["x"], plain["x"], rtol=1e-9)
