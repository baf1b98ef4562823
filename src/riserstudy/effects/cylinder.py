"""Tensioner cylinders between the tension ring (a node) and the deck: positions and directions of pull.

The reach of a cylinder is its extension from mid-stroke. Other effects (gas, spring, damping, end stop) give
the pull of the cylinder on the ring from the reach and its rate. This file converts the pull to forces on the
node. Upright cylinders pull vertically at any position of the ring, which is the usual model for small
angles. The deck above the cylinders moves up and down with the platform. Roll and pitch of the platform also
move the deck up and down.

References
----------
Elementary: the sum of vertical forces, kinematics of a point on a rigid body.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.attitude import turned
from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner
from riserstudy.solve.state import SUPPLIED


class Upright(NamedTuple):
    """Vertical cylinders."""

    node: int  # tension ring
    zero: np.ndarray  # (c,) elevation of the ring at mid-stroke, platform at rest (m)
    arm: np.ndarray  # (3,) from the platform's centre of rotation to the deck above the ring (m)
    point: np.ndarray  # (3, 3) scratch: arm turned, its velocity and acceleration


@inner
def _deck(cylinders, s):
    """Height of the deck above its place at rest, and its vertical velocity."""
    point = cylinders.point
    for k in range(3):
        point[0, k] = cylinders.arm[k]
    turned(s.platform, point[0], point[1], point[2])
    return s.platform[0, 2] + point[0, 2] - cylinders.arm[2], s.platform[1, 2] + point[1, 2]


@inner
def drive(cylinders, s):
    """Reach and rate from ring and deck."""
    up = len(s.dim) - 1
    height, rate = _deck(cylinders, s)
    for c in range(cylinders.zero.shape[0]):
        s.reach[c] = height - (s.r[up, cylinders.node] - cylinders.zero[c])
        s.reach_rate[c] = rate - s.v[up, cylinders.node]
    return 0.0


@inner
def force(cylinders, s):
    """The pull of all cylinders on the ring."""
    up = len(s.dim) - 1
    for c in range(cylinders.zero.shape[0]):
        s.force[up, cylinders.node] += s.pull[c]
    return 0.0


@inner
def tangent(cylinders, s):
    """Stiffness of all cylinders at the ring."""
    d = len(s.dim)
    for c in range(cylinders.zero.shape[0]):
        s.k_node[cylinders.node, d * d - 1] += s.k_pull[c]
    return 0.0


@inner
def power(cylinders, s):
    """Power that the platform supplies through the cylinders (W)."""
    _, rate = _deck(cylinders, s)
    for c in range(cylinders.zero.shape[0]):
        s.flow[SUPPLIED] += s.pull[c] * rate
    return 0.0


@inner
def probe(cylinders, s):
    """Report reach and pull of each cylinder."""
    count = s.reach.shape[0]
    for c in range(count):
        s.probe[c] = s.reach[c]
        s.probe[count + c] = s.pull[c]
    return 0.0


register(
    Upright,
    Called("tensioner cylinders", "top.tensioners"),
    drive=drive,
    device=force,
    tangent=tangent,
    power=power,
    probe=probe,
)
