r"""Morison drag from the component of the relative water velocity across the pipe.

.. math:: f = \tfrac12 \rho\,C_D D\,|u_n|\,u_n,\qquad u_n = (u - \dot r) - ((u - \dot r)\cdot t)\,t

The force f is per unstretched length, u is the water velocity, and t is the direction of the pipe. If the
drag acts horizontally, t is the vertical direction instead. The direction of the pipe at a node depends on
both neighbouring nodes. The exact derivative of a load that is shared with a neighbour would therefore not
fit into the band of the stiffness matrix. The engine computes the derivative with respect to the direction of
the pipe as if each load acted on one node only. The omitted term is small if the corrections of Newton's
iteration vary slowly from segment to segment. In motion, the derivatives with respect to the direction are
small compared with inertia, and the number of iterations is the same without these derivatives.

References
----------
Morison, O'Brien, Johnson and Schaaf (1950), "The force exerted by surface waves on piles", *Petroleum
Transactions AIME* 189, 149-154: its drag term.

Hoerner (1965), *Fluid-Dynamic Drag*: the drag on an inclined cylinder follows from the velocity across it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, put_in, register, taken_out
from riserstudy.solve.jit import inner
from riserstudy.solve.spread import spread_and_keep, spread_stiffness
from riserstudy.solve.state import ACCELERATION, DISSIPATED, OTHER, OWN, SUPPLIED, VELOCITY, axis
from riserstudy.solve.vec import (
    add,
    at,
    dot,
    mul,
    norm,
    norm_across,
    outer,
    plus_block,
    put,
    put_block,
    sub,
    unity,
    upward,
)

STILL = 1e-100  # (m/s) lower limit of a speed: the square of a much lower speed would underflow


class Drag(NamedTuple):
    """Drag of the segments."""

    low: np.ndarray  # (n,) rho C_D D / 2 times length, as it loads the lower node (kg/m)
    # (n,) as it loads the upper node (kg/m); the same where C_D is constant in a segment
    up: np.ndarray
    force: np.ndarray  # (d, n+1) scratch: drag on the nodes (N)
    horizontal: int  # 1: the drag acts horizontally, 0: across the pipe


@inner
def _relative(drag, s, i):
    """Component of the relative water velocity across the pipe, or horizontally, that causes drag."""
    u, t = sub(at(s.dim, s.water, i), at(s.dim, s.v, i)), axis(s, drag.horizontal, i)
    return sub(u, mul(dot(u, t), t))


@inner
def press(drag, s):
    """Write the load divided by its coefficient at the nodes to ``s.density``."""
    for i in range(s.l0.shape[0] + 1):
        u = _relative(drag, s, i)
        put(s.density, i, mul(norm_across(u, axis(s, drag.horizontal, i)), u))


@inner
def force(drag, s):
    """Drag on the nodes."""
    press(drag, s)
    spread_and_keep(s, drag.low, drag.up, OWN, OTHER, s.density, drag.force, s.force)
    return 0.0


@inner
def tangent(drag, s):
    """Derivative by velocity, by elevation in a sheared flow, and by the pipe's direction."""
    unit, up = unity(s.dim), upward(s.dim)
    for i in range(s.l0.shape[0] + 1):
        u, t = _relative(drag, s, i), axis(s, drag.horizontal, i)
        speed = norm_across(u, t)
        share = 1.0 / speed if speed > STILL else 0.0
        by_velocity = add(mul(speed, sub(unit, outer(t, t))), mul(share, outer(u, u)))
        shear = at(s.dim, s.shear, i)
        across = sub(shear, mul(dot(shear, t), t))
        by_elevation = add(mul(speed, across), mul(share * dot(u, across), u))
        put_block(s.block, i, sub(mul(s.rate[VELOCITY], by_velocity), outer(by_elevation, up)))
    spread_stiffness(s, drag.low, drag.up, OWN, OTHER)
    if not drag.horizontal and s.rate[ACCELERATION] == 0.0:
        _turning(drag, s)
    return 0.0


@inner
def _turning(drag, s):
    """Derivative by the positions of the nodes that define the pipe's direction."""
    unit, n = unity(s.dim), s.l0.shape[0]
    for i in range(n + 1):
        first, last = max(i - 1, 0), min(i + 1, n)
        chord = norm(sub(at(s.dim, s.r, last), at(s.dim, s.r, first)))
        near = 0.0
        if i > 0:
            near += (OWN + OTHER) * drag.up[i - 1]
        if i < n:
            near += (OWN + OTHER) * drag.low[i]
        t = at(s.dim, s.direction, i)
        w = sub(at(s.dim, s.water, i), at(s.dim, s.v, i))
        along = dot(w, t)
        u = sub(w, mul(along, t))
        speed = norm_across(u, t)
        share = along / speed if speed > STILL else 0.0
        turned = add(outer(t, u), mul(along, sub(unit, outer(t, t))))
        block = mul(near / chord, add(mul(speed, turned), mul(share, outer(u, u))))
        if i < n:
            plus_block(s.k_up, i, block)
        else:
            plus_block(s.k_node, i, block)
        if i > 0:
            plus_block(s.k_low, i - 1, mul(-1.0, block))
        else:
            plus_block(s.k_node, i, mul(-1.0, block))


@inner
def power(drag, s):
    """Power dissipated into the water, and power supplied by its motion (W); after ``force``."""
    slowed, supplied = 0.0, 0.0
    for i in range(s.l0.shape[0] + 1):
        f = at(s.dim, drag.force, i)
        slowed += dot(f, at(s.dim, s.v, i))
        supplied += dot(f, at(s.dim, s.water, i))
    s.flow[DISSIPATED] += supplied - slowed
    s.flow[SUPPLIED] += supplied
    return 0.0


register(
    Drag,
    Called(
        "drag",
        "riser.drag",
        (
            taken_out("drag", "riser[*].drag", "lateral", sets={"riser[*].drag": None, "current": None}),
            put_in(
                "drag",
                "riser[*].drag",
                {
                    "riser[*].drag": {"coefficient": 1.0, "diameter": "=outer diameter"},
                    "water.density": "=water",
                },
                "coefficient 1 on the outer diameter, in sea water",
                "lateral",
            ),
        ),
        lateral=True,
    ),
    string=force,
    tangent=tangent,
    power=power,
)
