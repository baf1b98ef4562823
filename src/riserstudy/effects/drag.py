r"""Morison drag across the pipe, with the velocity of the water relative to it.

.. math:: f = \tfrac12 \rho\,C_D D\,|u_n|\,u_n,\qquad u_n = (u - \dot r) - ((u - \dot r)\cdot t)\,t

per unstretched length. The change of the tangent t with position is left out of the stiffness; that
does not slow Newton's iteration for risers that stand or hang.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.effects.roles import register
from riserstudy.jit import inner
from riserstudy.solve.spread import spread, spread_stiffness
from riserstudy.solve.state import OTHER, OWN
from riserstudy.solve.vec import add, at, dot, mul, outer, put, put_block, sub, unity, upward


class Drag(NamedTuple):
    """Drag of the segments."""

    coefficient: np.ndarray  # (n,) rho C_D D / 2 times length (kg/m)
    force: np.ndarray  # (d, n+1) scratch


@inner
def _relative(s, i):
    """Velocity of the water across the pipe, seen from the pipe."""
    u, t = sub(at(s.dim, s.water, i), at(s.dim, s.v, i)), at(s.dim, s.direction, i)
    return sub(u, mul(dot(u, t), t))


@inner
def force(drag, s):
    """Drag on the nodes."""
    for i in range(s.l0.shape[0] + 1):
        u = _relative(s, i)
        put(s.density, i, mul(sqrt(dot(u, u)), u))
    spread(s, drag.coefficient, OWN, OTHER, s.density, s.force)
    return 0.0


@inner
def tangent(drag, s):
    """Derivative by the pipe's velocity, and by elevation where the current is sheared."""
    unit, up = unity(s.dim), upward(s.dim)
    for i in range(s.l0.shape[0] + 1):
        u, t = _relative(s, i), at(s.dim, s.direction, i)
        speed = sqrt(dot(u, u))
        share = 1.0 / speed if speed > 0.0 else 0.0
        by_velocity = add(mul(speed, sub(unit, outer(t, t))), mul(share, outer(u, u)))
        shear = at(s.dim, s.shear, i)
        across = sub(shear, mul(dot(shear, t), t))
        by_elevation = add(mul(speed, across), mul(share * dot(u, across), u))
        put_block(s.block, i, sub(mul(s.rate[0], by_velocity), outer(by_elevation, up)))
    spread_stiffness(s, drag.coefficient, OWN, OTHER)
    return 0.0


@inner
def power(drag, s):
    """Power dissipated into the water, and power supplied by its motion (W)."""
    for i in range(s.l0.shape[0] + 1):
        u = _relative(s, i)
        put(s.density, i, mul(sqrt(dot(u, u)), u))
    drag.force[:] = 0.0
    spread(s, drag.coefficient, OWN, OTHER, s.density, drag.force)
    for i in range(s.l0.shape[0] + 1):
        f, water = at(s.dim, drag.force, i), at(s.dim, s.water, i)
        s.flow[0] += dot(f, sub(water, at(s.dim, s.v, i)))
        s.flow[1] += dot(f, water)
    return 0.0


register(Drag, string=force, tangent=tangent, power=power)
