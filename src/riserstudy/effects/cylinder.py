"""Tensioner cylinders between the tension ring (a node) and the deck: positions and directions of pull.

The reach of a cylinder is its extension from mid-stroke. The laws in other files (gas, spring, damping,
end stop) give the pull on the ring from the reach and its rate. This file converts the pull to forces on
the node. Upright cylinders pull vertically at any position of the ring, which is the usual model for small
angles.

References
----------
Elementary: the sum of vertical forces.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner
from riserstudy.solve.state import SUPPLIED


class Upright(NamedTuple):
    """Vertical cylinders."""

    node: int  # tension ring
    zero: np.ndarray  # (c,) elevation of the ring at mid-stroke, platform at rest (m)


@inner
def drive(cylinders, s):
    """Reach and rate from ring and platform heave."""
    up = len(s.dim) - 1
    for c in range(cylinders.zero.shape[0]):
        s.reach[c] = s.platform[0, 2] - (s.r[up, cylinders.node] - cylinders.zero[c])
        s.reach_rate[c] = s.platform[1, 2] - s.v[up, cylinders.node]
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
    for c in range(cylinders.zero.shape[0]):
        s.flow[SUPPLIED] += s.pull[c] * s.platform[1, 2]
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
