"""The balance of energy does not depend on the datum of elevations, which the stored energy depends on."""

import numpy as np
import pytest

from riserstudy import load_scene
from riserstudy.records.warning import sentences
from riserstudy.simulation import audit
from riserstudy.simulation.refine import run

SCENE = """
title: a pipe under a constant tension, aside from its well
gravity: 9.81 m/s^2
water: {{density: 1025 kg/m^3}}
riser:
  - {{name: pipe, length: {length!r} m, axial_stiffness: 4 GN, mass: 500 kg/m,
     bending_stiffness: 100 MN*m^2, submerged_weight: {weight!r} N/m,
     added_mass: {{coefficient: 1.0, diameter: 0.5 m}}}}
bottom: {{hold: wellhead, elevation: 0 m, rotation: free}}
top: {{x: {x}, {lateral} z: free, rotation: free, tension: {tension!r} N}}
{platform}
analysis: {{duration: 20 s, mesh: {{elements: 40}}, step: 0.1 s, output: {{interval: 1 s}}}}
"""


@pytest.mark.parametrize("seed", range(8))
def test_an_energy_of_zero_by_the_datum_has_no_warning(seed, tmp_path, monkeypatch):
    """At rest or in a tiny motion, in elevations in which the stored energy is zero."""
    draw = np.random.default_rng(seed)
    length, weight = float(draw.uniform(300.0, 2000.0)), float(draw.uniform(2000.0, 4000.0))
    tension = float(draw.uniform(1.2, 1.6)) * weight * length
    aside = f"offset: {0.03 * length!r} m,"
    moved = "platform: {surge: {amplitude: 0.01 mm, period: 10 s}}"
    x, lateral, platform = ("platform", "", moved) if seed % 2 else ("held", aside, "")
    path = tmp_path / "scene.yaml"
    path.write_text(SCENE.format(**locals()))
    stored, judge = [], audit.energy
    monkeypatch.setattr(audit, "energy", lambda *of: (stored.append(of[2]), judge(*of)))

    def raised(by):
        scene = load_scene(path, **{"bottom.elevation": f"{by!r} m"}).resolved()
        return run(scene, estimated=False).facts

    raised(0.0), raised(100.0)
    facts = raised(100.0 * stored[0] / (stored[0] - stored[1]))  # the energy is linear in the datum
    assert abs(stored[-1]) < 1e-6 * abs(stored[0])
    assert not [text for text in sentences(facts["warnings"]) if text.startswith("energy")]
    assert facts["audit"]["unexplained_share"] < 1e-4
