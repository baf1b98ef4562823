r"""Flex joints and clamps: the riser's end held in direction.

.. math:: M = K\,(\theta_{riser} - \theta_{held}),

entered as the flexibility 1/K of the end node, so that a clamp is 1/K = 0 and stiffness has no upper
limit. The held direction is the vertical, a fixed lean, or the platform's own vertical (its pitch).
"""

from __future__ import annotations

from math import atan2
from typing import NamedTuple

from riserstudy.effects.registry import register
from riserstudy.solve.jit import inner
from riserstudy.solve.state import SUPPLIED


class FlexJoint(NamedTuple):
    """One joint at an end of the riser."""

    node: int  # 0 or n
    flex: float  # 1/K (rad/(N m)), 0 for a clamp
    lean: float  # held direction from the vertical, towards +x (rad)
    follows: float  # 1 when the direction turns with the platform, else 0


@inner
def _held(joint, s):
    return joint.lean + joint.follows * s.platform[0, 4]


@inner
def compliance(joint, s):
    """Enter the flexibility of the joint."""
    s.flex[joint.node] += joint.flex
    return 0.0


@inner
def turn(joint, s):
    """The angle between the end segment and the held direction is taken up by moments."""
    e = 0 if joint.node == 0 else joint.node - 1
    away = atan2(s.tangent[0, e], s.tangent[1, e]) - _held(joint, s)
    s.turn[0, joint.node] += away if joint.node == 0 else -away
    return 0.0


@inner
def energy(joint, s):
    """Energy in the joint's spring (J)."""
    return 0.5 * joint.flex * s.moment[0, joint.node] ** 2


@inner
def power(joint, s):
    """Power that the turning platform supplies through the joint (W)."""
    sign = -1.0 if joint.node == 0 else 1.0
    s.flow[SUPPLIED] += sign * joint.follows * s.moment[0, joint.node] * s.platform[1, 4]
    return 0.0


register(FlexJoint, compliance=compliance, turn=turn, potential=energy, power=power)
