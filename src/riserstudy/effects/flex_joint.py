r"""Flex joints (rotational springs) and clamps at the ends of the riser.

.. math:: M = K\,\theta

Here K is the stiffness of the joint, and :math:`\theta` is the rotation from the direction of the support to
the direction of the riser. In a plane, the rotation is a number; in space, it is a vector. The model
represents the joint by the flexibility 1/K at the end node. A clamp therefore has the flexibility 1/K = 0,
and the stiffness K has no upper limit. The direction of the support is fixed, or rotates with the platform.

References
----------
Elementary: Hooke's law of a rotational spring, with Euler's theorem for the rotation.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.attitude import turned
from riserstudy.effects.registry import Called, register, taken_out
from riserstudy.effects.rotation import by_chord, rotation, rotation_by_first, rotation_by_second
from riserstudy.solve.jit import inner
from riserstudy.solve.state import SUPPLIED
from riserstudy.solve.vec import at, bending_at, cross, dot, plus, plus_block, within


class FlexJoint(NamedTuple):
    """One joint at an end of the riser."""

    node: int  # 0 or n
    flex: float  # 1/K (rad/(N m)), 0 for a clamp
    lean: np.ndarray  # (3,) held direction, unit vector
    follows: int  # 1 if it rotates with the platform, else 0
    held: np.ndarray  # (3, 3) scratch: held direction now, its first and second time derivative


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
def compliance(joint, s):
    """Add the flexibility of the joint."""
    s.flex[joint.node] += joint.flex
    return 0.0


@inner
def turn(joint, s):
    """Add the rotation between the held direction and the end segment to the turning angles."""
    if joint.node == 0:
        plus(s.turn, 0, rotation(within(s.dim, joint.held, 0), at(s.dim, s.tangent, 0)))
    else:
        t = at(s.dim, s.tangent, joint.node - 1)
        plus(s.turn, joint.node, rotation(t, within(s.dim, joint.held, 0)))
    return 0.0


@inner
def tangent(joint, s):
    """Derivative of this rotation by the end segment."""
    if joint.node == 0:
        slope = rotation_by_second(within(s.dim, joint.held, 0), at(s.dim, s.tangent, 0))
        plus_block(s.turn_low, 0, by_chord(s, 0, slope))
    else:
        e = joint.node - 1
        slope = rotation_by_first(at(s.dim, s.tangent, e), within(s.dim, joint.held, 0))
        plus_block(s.turn_up, e, by_chord(s, e, slope))
    return 0.0


@inner
def energy(joint, s):
    """Energy in the joint's spring (J)."""
    moment = bending_at(s.dim, s.moment, joint.node)
    return 0.5 * joint.flex * dot(moment, moment)


@inner
def power(joint, s):
    """Power that the rotating platform supplies through the joint (W)."""
    turning = cross(within(s.dim, joint.held, 0), within(s.dim, joint.held, 1))
    sign = -1.0 if joint.node == 0 else 1.0
    s.flow[SUPPLIED] += sign * dot(bending_at(s.dim, s.moment, joint.node), turning)
    return 0.0


register(
    FlexJoint,
    Called(
        "flex joint",
        "rotation.stiffness",
        (
            taken_out(
                "lower flex joint", "bottom.rotation.stiffness", "lateral", sets={"bottom.rotation": "free"}
            ),
            taken_out("upper flex joint", "top.rotation.stiffness", "lateral", sets={"top.rotation": "free"}),
        ),
        lateral=True,
    ),
    Called("clamp", "rotation: fixed", lateral=True),
    compliance=compliance,
    place=place,
    turn=turn,
    tangent=tangent,
    potential=energy,
    power=power,
)
