"""Bending in space: a case, the plain version, and a cantilever loaded from every side."""

from __future__ import annotations

import numpy as np
import pytest
from plain import along, rotations
from small_scenes import simulated
from surroundings import Case, flexibility, nodes, pipe

from riserstudy.effects.bending_in_space import SpatialBending

SCENE = """\
title: cantilever in a current from the side
water: {density: 1000 kg/m^3, surface: 50 m, seabed: 0 m}
riser:
  - name: beam
    length: 50 m
    axial_stiffness: 10 GN
    bending_stiffness: 300 MN*m^2
    submerged_weight: 0 N/m
    drag: {coefficient: 1.0, diameter: 0.5 m}
bottom: {hold: wellhead, elevation: 0 m, rotation: fixed}
top: {x: free, z: free, rotation: free}
current:
  profile: [{elevation: 0 m, speed: 0.2 m/s}, {elevation: 50 m, speed: 0.2 m/s}]
  heading: HEADING deg
  beyond: hold
analysis: {mesh: {elements: 40}}
"""


def spatial_bending(record, s):
    length, t = along(s)
    turn = np.zeros_like(s.turn)
    turn[:, 1:-1] = rotations(t[:, :-1], t[:, 1:])
    turn -= s.moment @ flexibility(s)
    return {"turn": turn, "force": nodes(np.cross(t, np.diff(s.moment, axis=1), axis=0) / length)}


CASES = {SpatialBending: Case(pipe, directions=(3,))}

PLAIN = {SpatialBending: [("turn string", spatial_bending)]}


@pytest.mark.parametrize("heading", [30.0, 90.0, 200.0])
def test_a_cantilever_bends_towards_its_load_in_every_direction(tmp_path, heading):
    """q L^4 / (8 EI) at the end and q L^2 / 2 at the clamp, at a slope of 7e-4."""
    found = simulated(tmp_path, SCENE.replace("HEADING", str(heading)))
    load = 0.5 * 1000.0 * 0.5 * 0.2**2
    end = load * 50.0**4 / (8.0 * 300e6)
    towards = end * np.array([np.cos(np.radians(heading)), np.sin(np.radians(heading))])
    # 40 segments, of second order
    np.testing.assert_allclose([found["x"][-1], found["y"][-1]], towards, atol=1e-3 * end)
    moment = float(np.abs(found["bending_moment"][0]))
    assert moment == pytest.approx(0.5 * load * 50.0**2, rel=1e-3)
