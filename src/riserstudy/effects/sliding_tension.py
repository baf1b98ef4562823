r"""Tension of a telescopic joint held constant along its axis, by tensioners of unlimited reach.

.. math:: T = T_0 + k\,\max(0, \ell - \ell_{stop})

with a stop at full stroke where there is one.

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
    """Tension of one segment, whatever its length."""

    segment: int
    tension: float  # T_0 (N)
    stop: float  # length at which the stop touches (m), infinite for none
    stiffness: float  # of the stop (N/m)


@inner
def _tension(joint, s):
    return joint.tension + joint.stiffness * max(s.length[joint.segment] - joint.stop, 0.0)


@inner
def force(joint, s):
    """Tension along the joint."""
    e = joint.segment
    plus(s.segment, e, mul(_tension(joint, s), at(s.dim, s.tangent, e)))
    return 0.0


@inner
def tangent(joint, s):
    """The stop along the joint, T / length across it."""
    e = joint.segment
    t, unit = at(s.dim, s.tangent, e), unity(s.dim)
    along = outer(t, t)
    stop = joint.stiffness if s.length[e] > joint.stop else 0.0
    string = mul(_tension(joint, s) * s.inverse_length[e], sub(unit, along))
    plus_block(s.k_segment, e, add(mul(stop, along), string))
    return 0.0


@inner
def energy(joint, s):
    """Work stored in tensioners and stop (J)."""
    length = s.length[joint.segment]
    beyond = max(length - joint.stop, 0.0)
    return joint.tension * length + 0.5 * joint.stiffness * beyond * beyond


register(
    SlidingTension,
    Called("sliding tension", "top.telescopic_joint.tension"),
    string=force,
    tangent=tangent,
    potential=energy,
)
