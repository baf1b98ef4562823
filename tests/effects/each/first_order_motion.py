"""First-order motion: a case, the plain version, and a vessel too heavy to drift."""

from __future__ import annotations

import numpy as np
from plain import carried
from small_scenes import simulated
from surroundings import TOP, Case, N, pair

from riserstudy.effects.first_order_motion import FirstOrderMotion

SCENE = """\
title: string below a heavy vessel in waves
riser: [{name: string, length: 100 m, axial_stiffness: 10 GN, mass: 400 kg/m}]
bottom: {hold: wellhead, elevation: 0 m}
top: {x: TOP, z: free, tension: 2 MN}
platform:
  pitch: {amplitude: 2 deg, period: 6 s, ramp: 12 s}
  surge: {amplitude: 1 m, period: 9 s, ramp: 9 s}
  centre_of_rotation: {elevation: 70 m}
analysis: {duration: 24 s, output: {interval: 0.5 s}, mesh: {elements: 10}, step: 0.05 s}
"""


def first_order_motion(record, s):
    """What the top has beside its own; accelerations by differences, and that it moves: compared apart."""
    lateral = len(s.r) - 1
    moved = s.platform[:, :3] + carried(s.platform, record.arm)
    moved[0] -= record.arm
    out = s.carried.copy()
    out[:2, :lateral] = moved[:2, :lateral]
    return {"carried": out}


CASES = {
    FirstOrderMotion: Case(
        lambda d: FirstOrderMotion(
            N, d - 1, pair(1.0, -2.0), np.array([3.0, -1.0, TOP]), np.zeros((3, 3)), 0
        ),
        directions=(2, 3),
    )
}

PLAIN = {FirstOrderMotion: [("place", first_order_motion)]}


def test_below_a_vessel_too_heavy_to_drift_the_riser_moves_as_below_a_platform(tmp_path):
    vessel = {"vessel": {"mass": "1e13 kg"}}
    drifting = simulated(tmp_path, SCENE.replace("TOP", "vessel"), vessel)
    carried = simulated(tmp_path, SCENE.replace("TOP", "platform"))
    # 1e5 N for 24 s move it by 3e-6 m
    np.testing.assert_allclose(drifting["x"], carried["x"], atol=2e-5)
    np.testing.assert_allclose(drifting["low_frequency_surge"], 0.0, atol=2e-5)
    late = drifting["time"].values >= 12.0
    t = drifting["time"].values[late]
    pitch = np.radians(2.0) * np.sin(2.0 * np.pi * t / 6.0)
    # the top is 30 m above the centre of rotation, and 0.02 m more by its tension
    top = np.sin(2.0 * np.pi * t / 9.0) + 30.02 * np.sin(pitch)
    np.testing.assert_allclose(drifting["x"].isel(s=-1).values[late], top, atol=2e-5)
