"""Weight: a case, the plain version, strings that stretch and sag, and a body that falls."""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies, energy, motion
from surroundings import Case, N

from riserstudy import simulate
from riserstudy.effects.weight import Weight


def weight(record, s):
    out = np.zeros_like(s.force)
    out[record.direction] = record.load
    return {"force": out}


CASES = {Weight: Case(lambda d: Weight(d - 1, -1e4 * np.linspace(1.0, 2.0, N + 1)))}

PLAIN = {Weight: [("string", weight)]}

# without a load, in a plane on n segments
UNLOADED = {"weight": lambda n: Weight(1, np.zeros(n + 1))}


SCENE = """\
title: string with weight and load
water: {density: 1025 kg/m^3}
riser: [{name: string, length: 100 m, axial_stiffness: 100 MN, submerged_weight: 4 kN/m}]
bottom: {hold: wellhead, elevation: 0 m}
top: {x: held, z: free, tension: 1 MN}
analysis: {mesh: {elements: 10}}
"""


def equilibrium(scene_of, **changes):
    return simulate(scene_of(SCENE, **changes))


def test_weight_lowers_tension_and_stretches_the_string_half_as_much_as_at_its_end(scene_of):
    """T = P - w (L - s), and the top rises by P L / EA - w L^2 / 2 EA."""
    found = equilibrium(scene_of)
    s = found["s"].values
    # tensions of segments stand at their middles, at nodes their means: exact inside, where T is straight
    np.testing.assert_allclose(found["effective_tension"][1:-1], 1e6 - 4e3 * (100.0 - s[1:-1]), rtol=1e-9)
    stretched = 1e6 * 100.0 / 1e8 - 4e3 * 100.0**2 / 2e8
    assert float(found["z"][-1]) - 100.0 == pytest.approx(stretched, rel=1e-9)


def test_a_load_across_a_string_sags_it_to_a_parabola(scene_of):
    """x = w s (L - s) / 2 T for small slopes."""
    load = {"riser[0].submerged_weight": "0 N/m", "riser[0].lateral_load": "20 N/m"}
    stiff = {"riser[0].axial_stiffness": "10 TN"}
    found = equilibrium(scene_of, **load, **stiff)
    s = found["s"].values
    # slopes of 0.001: their squares, 1e-6; and a strain of 1e-7
    np.testing.assert_allclose(found["x"], 20.0 * s * (100.0 - s) / 2e6, atol=1e-5 * 0.025)


def test_a_body_falls_along_a_parabola_and_keeps_its_energy():
    mass, load = 3e3, np.array([0.0, -2e4])
    model = bodies(Weight(2, load, level=7.0), mass=mass)
    model.s.v[:, UPPER] = 2.0, 1.0, 5.0
    before = energy(model)
    found = motion(model, 3.0, 50)
    t = found.time
    fallen = np.array([2.0 * t, t, 1.0 + 5.0 * t - 0.5 * 2e4 / mass * t**2]).T
    np.testing.assert_allclose(found.place[..., UPPER], fallen, atol=1e-9)
    assert energy(model) == pytest.approx(before, rel=1e-9)
