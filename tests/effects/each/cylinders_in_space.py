"""Cylinders in space: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import carried
from surroundings import Case, N, pair

from riserstudy.effects.cylinders_in_space import CylindersInSpace
from riserstudy.effects.linear_spring import LinearSpring
from riserstudy.model.layout import AXES


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
