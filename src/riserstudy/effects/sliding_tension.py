r"""Constant pull of tensioners along a telescopic joint, and the end stops of the joint.

.. math:: T = T_0 + k\,[\max(0, \ell - \ell_{out}) + \min(0, \ell - \ell_{in})]

Here T_0 is the constant pull, and :math:`\ell` the length of the joint. The joint has a stop at the largest
extension, a stop where the barrels meet, or both stops. The stops are elastic springs with the stiffness k,
without energy loss. A joint that is compressed to its inner stop pushes, so the axial force of the joint can
be a compression.

References
----------
Elementary: a constant force, with Hooke's law at the stop.
"""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner
from riserstudy.solve.vec import add, at, mul, outer, plus, plus_block, sub, unity


class SlidingTension(NamedTuple):
    """Tension of one segment, which depends on its length only at the stops."""

    segment: int
    tension: float  # T_0 (N)
    longest: float  # length at which the outer stop touches (m), infinite for none
    shortest: float  # length at which the inner stop touches (m), 0 for none
    stiffness: float  # of the stops (N/m)


@inner
def _beyond(joint, s):
    length = s.length[joint.segment]
    return max(length - joint.longest, 0.0) + min(length - joint.shortest, 0.0)


@inner
def _tension(joint, s):
    return joint.tension + joint.stiffness * _beyond(joint, s)


@inner
def force(joint, s):
    """Tension along the joint."""
    e = joint.segment
    plus(s.segment, e, mul(_tension(joint, s), at(s.dim, s.tangent, e)))
    return 0.0


@inner
def tangent(joint, s):
    """Stiffness of the stops along the joint, and T / length across it."""
    e = joint.segment
    t, unit = at(s.dim, s.tangent, e), unity(s.dim)
    along = outer(t, t)
    stop = joint.stiffness if _beyond(joint, s) != 0.0 else 0.0
    string = mul(_tension(joint, s) * s.inverse_length[e], sub(unit, along))
    plus_block(s.k_segment, e, add(mul(stop, along), string))
    return 0.0


@inner
def energy(joint, s):
    """Work stored in tensioners and stops (J)."""
    beyond = _beyond(joint, s)
    return joint.tension * s.length[joint.segment] + 0.5 * joint.stiffness * beyond * beyond


register(
    SlidingTension,
    Called("sliding tension", "top.telescopic_joint.tension or stop"),
    string=force,
    tangent=tangent,
    potential=energy,
)
