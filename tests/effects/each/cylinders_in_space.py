"""Cylinders in space: a case, the plain version, and a deck that rises and turns."""

from __future__ import annotations

import numpy as np
from plain import carried
from small_scenes import simulated
from surroundings import Case, N, pair

from riserstudy.effects.cylinders_in_space import CylindersInSpace
from riserstudy.effects.linear_spring import LinearSpring
from riserstudy.model.layout import AXES

SCENE = """\
title: bar on inclined cylinders
riser: [{name: bar, length: 100 m, axial_stiffness: 1e13 N, bending_stiffness: 300 MN*m^2}]
bottom: {hold: wellhead, elevation: 0 m}
top:
  x: platform
  z: platform
  elevation: 110 m
  telescopic_joint: {length: 10 m, bending_stiffness: 300 MN*m^2}
  tensioners:
    count: 6
    linear: {tension: 200 kN, stiffness: 50 kN/m}
    mid_stroke: riser unstretched
    arrangement: {ring_radius: 1 m, deck_radius: 4 m, deck_elevation: 110 m, first_bearing: 20 deg}
platform:
  position: {heave: 2 m, yaw: 25 deg}
  centre_of_rotation: {elevation: 90 m}
analysis: {mesh: {elements: 5}}
"""


def cylinders_in_space(record, s):
    axes = AXES[len(s.dim)]
    ring = np.zeros((2, 3))
    ring[0, axes], ring[1, axes] = s.r[:, record.node], s.v[:, record.node]
    force = np.zeros_like(s.force)
    reach, rate = [], []
    for c in range(len(record.length)):
        deck = s.platform[:, :3] + carried(s.platform, record.deck[:, c])
        line = record.centre + deck[0] - ring[0]
        distance = np.sqrt((line**2).sum())
        reach.append(distance - record.length[c])
        rate.append(line @ (deck[1] - ring[1]) / distance)
        force[:, record.node] += s.pull[c] * line[axes] / distance
    return {"force": force, "reach": np.array(reach), "reach_rate": np.array(rate)}


CASES = {
    CylindersInSpace: Case(
        lambda d: CylindersInSpace(
            node=N - 1,
            vessel=0,
            centre=np.array([0.5, -0.2, 55.0]),
            deck=np.array([[2.0, -2.5], [0.3, -0.4], [8.0, 9.0]]),
            ring=np.zeros((3, 2)),  # the moment's derivative is left out, as its file says
            length=pair(11.0, 12.0),
            below=np.zeros(2),
            above=np.zeros(2),
            work=np.zeros((3, 3)),
            base=np.zeros((2, 3)),
        ),
        lambda d: [LinearSpring(pair(8e5, 7e5), pair(3e4, 2e4))],
    )
}

PLAIN = {CylindersInSpace: [("place drive device", cylinders_in_space)]}


def test_a_deck_that_rises_and_turns_pulls_by_the_lengths_of_its_lines(tmp_path):
    """Law of cosines: l^2 = a^2 + b^2 - 2 a b cos(yaw) + h^2; each line pulls up by h / l of its pull."""
    found = simulated(tmp_path, SCENE)
    across = 1.0 + 16.0 - 8.0 * np.cos(np.radians(25.0))
    length, at_mid_stroke = np.sqrt(across + 12.0**2), np.sqrt(9.0 + 10.0**2)
    pull = 200e3 + 50e3 * (length - at_mid_stroke)
    # the bar stretches by 1e-5 m
    np.testing.assert_allclose(found["tensioner_stroke"], length - at_mid_stroke, rtol=1e-4)
    np.testing.assert_allclose(found["tensioner_force"], pull, rtol=1e-5)
    np.testing.assert_allclose(found["effective_tension"][0], 6.0 * pull * 12.0 / length, rtol=1e-5)
