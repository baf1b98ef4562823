r"""Flex joints and clamps of a riser in space: its end held in direction.

.. math:: M = K\,\theta

with the vector of the rotation from the held direction to the riser's, entered as the flexibility 1/K of
the end node. The held direction is fixed, or turns with the platform.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.attitude import turned
from riserstudy.effects.bending_in_space import (
    by_chord,
    rotation,
    rotation_by_first,
    rotation_by_second,
)
from riserstudy.effects.flex_joint import compliance
from riserstudy.effects.registry import register
from riserstudy.solve.jit import inner
from riserstudy.solve.state import SUPPLIED
from riserstudy.solve.vec import at, cross, dot, plus, plus_block


class SpatialFlexJoint(NamedTuple):
    """One joint at an end of the riser."""

    node: int  # 0 or n
    flex: float  # 1/K (rad/(N m)), 0 for a clamp
    lean: np.ndarray  # (3,) held direction, unit vector
    follows: int  # 1 when it turns with the platform, else 0
    held: np.ndarray  # (3, 3) scratch: held direction now, its first and second rate


@inner
def place(joint, s):
    """The held direction at this time."""
    held = joint.held
    for c in range(3):
        held[0, c], held[1, c], held[2, c] = joint.lean[c], 0.0, 0.0
    if joint.follows > 0:
        turned(s.platform, held[0], held[1], held[2])
    return 0.0


@inner
def _direction(joint):
    held = joint.held
    return (held[0, 0], held[0, 1], held[0, 2])


@inner
def turn(joint, s):
    """The rotation between the held direction and the end segment is taken up by moments."""
    if joint.node == 0:
        plus(s.turn, 0, rotation(_direction(joint), at(s.dim, s.tangent, 0)))
    else:
        t = at(s.dim, s.tangent, joint.node - 1)
        plus(s.turn, joint.node, rotation(t, _direction(joint)))
    return 0.0


@inner
def tangent(joint, s):
    """How that rotation follows the end segment."""
    if joint.node == 0:
        slope = rotation_by_second(_direction(joint), at(s.dim, s.tangent, 0))
        plus_block(s.turn_low, 0, by_chord(s, 0, slope))
    else:
        e = joint.node - 1
        slope = rotation_by_first(at(s.dim, s.tangent, e), _direction(joint))
        plus_block(s.turn_up, e, by_chord(s, e, slope))
    return 0.0


@inner
def energy(joint, s):
    """Energy in the joint's spring (J)."""
    moment = at(s.dim, s.moment, joint.node)
    return 0.5 * joint.flex * dot(moment, moment)


@inner
def power(joint, s):
    """Power that the turning platform supplies through the joint (W)."""
    held = joint.held
    turning = cross(_direction(joint), (held[1, 0], held[1, 1], held[1, 2]))
    sign = -1.0 if joint.node == 0 else 1.0
    s.flow[SUPPLIED] += sign * dot(at(s.dim, s.moment, joint.node), turning)
    return 0.0


register(
    SpatialFlexJoint,
    compliance=compliance,
    place=place,
    turn=turn,
    tangent=tangent,
    potential=energy,
    power=power,
)
