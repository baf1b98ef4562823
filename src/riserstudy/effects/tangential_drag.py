r"""Drag from the component of the relative water velocity along the pipe.

.. math:: f = \tfrac12 \rho\,C_t\,\pi D\,|u_t|\,u_t\,t,\qquad u_t = (u - \dot r)\cdot t

The force f is per unstretched length, t is the direction of a segment, and the velocities are the means of
the velocities at its two ends. Half of the load acts at each end. The load of a segment depends only on the
positions and velocities of its two nodes. The tangent matrix is therefore exact, and the load never supplies
energy to a pipe in still water.

References
----------
The same equation, with the circumference as area: Hall and Goupee (2015), "Validation of a lumped-mass
mooring line model with DeepCwind semisubmersible model test data", *Ocean Engineering* 104, 590-603.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, put_in, register, taken_out
from riserstudy.solve.jit import inner
from riserstudy.solve.state import DISSIPATED, SUPPLIED, VELOCITY
from riserstudy.solve.vec import add, at, dot, mul, outer, plus, plus_block, sub, unity, upward


class TangentialDrag(NamedTuple):
    """Drag along the segments."""

    low: np.ndarray  # (n,) rho C_t pi D / 2 times length (kg/m)


@inner
def _slip(s, e):
    """Relative velocity of the water along a segment, as the mean of its two ends."""
    below = sub(at(s.dim, s.water, e), at(s.dim, s.v, e))
    above = sub(at(s.dim, s.water, e + 1), at(s.dim, s.v, e + 1))
    return mul(0.5, add(below, above))


@inner
def force(drag, s):
    """Drag on the nodes, half of each segment's drag at each end."""
    for e in range(s.l0.shape[0]):
        t = at(s.dim, s.tangent, e)
        u = dot(t, _slip(s, e))
        half = mul(0.5 * drag.low[e] * abs(u) * u, t)
        plus(s.force, e, half)
        plus(s.force, e + 1, half)
    return 0.0


@inner
def tangent(drag, s):
    """Derivative by velocity, by elevation in a sheared flow, and by the segment's direction."""
    unit, up = unity(s.dim), upward(s.dim)
    for e in range(s.l0.shape[0]):
        t, c = at(s.dim, s.tangent, e), 0.5 * drag.low[e]
        slip = _slip(s, e)
        u = dot(t, slip)
        along = outer(t, t)
        across = sub(slip, mul(u, t))
        turning = add(mul(2.0 * abs(u), outer(t, across)), mul(abs(u) * u, sub(unit, along)))
        turned = mul(c * s.inverse_length[e], turning)  # by the upper end; minus that by the lower
        slower = mul(s.rate[VELOCITY] * c * abs(u), along)  # minus the derivative, by either end
        sheared = mul(c * abs(u), outer(t, up))
        low = mul(dot(at(s.dim, s.shear, e), t), sheared)
        high = mul(dot(at(s.dim, s.shear, e + 1), t), sheared)
        by_low = sub(add(slower, turned), low)
        by_high = sub(sub(slower, turned), high)
        plus_block(s.k_node, e, by_low)
        plus_block(s.k_low, e, by_low)
        plus_block(s.k_node, e + 1, by_high)
        plus_block(s.k_up, e, by_high)
    return 0.0


@inner
def power(drag, s):
    """Power dissipated into the water, and power supplied by its motion (W)."""
    for e in range(s.l0.shape[0]):
        t = at(s.dim, s.tangent, e)
        u = dot(t, _slip(s, e))
        pull = drag.low[e] * abs(u) * u
        water = mul(0.5, add(at(s.dim, s.water, e), at(s.dim, s.water, e + 1)))
        s.flow[DISSIPATED] += pull * u
        s.flow[SUPPLIED] += pull * dot(t, water)
    return 0.0


register(
    TangentialDrag,
    Called(
        "tangential drag",
        "riser.tangential_drag",
        (
            taken_out("tangential drag", "riser[*].tangential_drag"),
            put_in(
                "tangential drag",
                "riser[*].tangential_drag",
                {
                    "riser[*].tangential_drag": {"coefficient": 0.02, "diameter": "=outer diameter"},
                    "water.density": "=water",
                },
                "coefficient 0.02 on the outer diameter, in sea water",
                "dynamics",
            ),
        ),
    ),
    string=force,
    tangent=tangent,
    power=power,
)
