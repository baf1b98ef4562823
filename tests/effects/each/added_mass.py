"""Added mass: a case, the plain version, and a string that moves water or contents aside."""

from __future__ import annotations

import math

import numpy as np
import pytest
from plain import across, axes, spread
from small_scenes import simulated
from surroundings import SEGMENTS, Case

from riserstudy import load_scene
from riserstudy.effects.added_mass import AddedMass
from riserstudy.simulation.modes import modes_of

SCENE = """\
title: string on a surging platform
riser: [{name: string, length: 100 m, axial_stiffness: 1e11 N, mass: 200 kg/m, submerged_weight: 0 N/m}]
bottom: {hold: wellhead, elevation: 0 m}
top: {x: platform, z: free, tension: 2 MN}
platform: {surge: {amplitude: 0.1 m, period: 6 s, ramp: 180 s}}
analysis:
  duration: 210 s
  output: {interval: 0.25 s, start: 192 s}
  mesh: {elements: 20}
  step: 0.05 s
"""


WATER = {"density": "1000 kg/m^3", "surface": "100 m", "seabed": "0 m"}


def added_mass(record, s):
    return {"force": -spread(record.mass, across(s.a, axes(record, s)))}


CASES = {AddedMass: Case(lambda d: AddedMass(7e3 * SEGMENTS, -7e3 * SEGMENTS, 0))}

PLAIN = {AddedMass: [("string_inertia", added_mass)]}

# without a load, in a plane on n segments
UNLOADED = {"added mass": lambda n: AddedMass(np.zeros(n), np.zeros(n), 0)}


@pytest.mark.parametrize(
    "what, value",
    [("added_mass", {"coefficient": 2.0, "diameter": "0.5 m"}), ("contents", {"density": "2000 kg/m^3"})],
)
def test_water_and_contents_move_with_a_string_as_its_own_mass_does(tmp_path, what, value):
    """x = A sin(k s) / sin(k L), k = omega sqrt((m + m_n) / T), with 392.7 kg/m across the pipe."""
    moved = 2000.0 * math.pi * 0.5**2 / 4.0
    # a pipe as much lighter than water as its contents weigh
    pipe = {
        "outer_diameter": "0.52 m",
        "inner_diameter": "0.5 m",
        "submerged_weight": f"{-10.0 * moved!r} N/m",
    }
    values = {"water": WATER, f"riser[0].{what}": value, "gravity": "10 m/s^2"}
    values |= {f"riser[0].{name}": known for name, known in pipe.items() if what == "contents"}
    found = simulated(tmp_path, SCENE, values)
    k = 2.0 * np.pi / 6.0 * np.sqrt((200.0 + moved) / 2e6)
    shape = np.sin(k * found["s"].values) / np.sin(100.0 * k)
    expected = np.outer(found["x"].isel(s=-1), shape)
    # both ends of the ramp leave a little of the free vibration
    np.testing.assert_allclose(found["x"].transpose("time", "s"), expected, atol=5e-4 * 0.1)


def test_added_mass_does_not_resist_motion_along_the_pipe(tmp_path):
    file = tmp_path / "scene.yaml"
    file.write_text(SCENE)
    added = {"water": WATER, "riser[0].added_mass": {"coefficient": 2.0, "diameter": "0.5 m"}}
    dry, wet = (modes_of(load_scene(file, **values).resolved(), 20) for values in ({}, added))
    along, also = (found["frequency"][found["motion"] == "axial"].values for found in (dry, wet))
    assert len(along) > 0
    np.testing.assert_allclose(also, along, rtol=1e-9)
