"""Support of a node in some directions: the node is fixed, or moves with the platform.

References
----------
Elementary: kinematics of a point on a rigid body.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.attitude import turned
from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner


class Support(NamedTuple):
    """Held directions of one node."""

    node: int
    place: np.ndarray  # (3,) position with the platform at rest (m)
    axis: np.ndarray  # (d,) index of each direction among x, y, z
    held: np.ndarray  # (d,) 1 where held, else 0
    follows: np.ndarray  # (d,) 1 where it moves with the platform, else 0
    arm: np.ndarray  # (3,) from the platform's centre of rotation (m)
    point: np.ndarray  # (3, 3) scratch: arm turned, its velocity and acceleration


@inner
def place(support, s):
    """Set position, velocity and acceleration of the node in its held directions."""
    i, point = support.node, support.point
    for c in range(3):
        point[0, c] = support.arm[c]
    turned(s.platform, point[0], point[1], point[2])
    for k in range(len(s.dim)):
        if support.held[k] > 0:
            m = support.axis[k]
            s.r[k, i], s.v[k, i], s.a[k, i] = support.place[m], 0.0, 0.0
            if support.follows[k] > 0:
                s.r[k, i] += s.platform[0, m] + point[0, m] - support.arm[m]
                s.v[k, i] += s.platform[1, m] + point[1, m]
                s.a[k, i] += s.platform[2, m] + point[2, m]
    return 0.0


register(Support, Called("support", "bottom.hold, top.x, top.z"), place=place)
