r"""Vortex-induced vibration across the flow: lift that synchronises with the riser's motion.

Vortices shed from a pipe cause a lift force across the flow. With the velocity u of the water relative to
the pipe and across it, the tangent t of the pipe, and :math:`n = u/|u|`, the lift per unstretched length
is

.. math:: f = \tfrac12 \rho\,C_v D\,|u|\,(t \times u)\cos\varphi

The phase :math:`\varphi` follows the velocity of the riser across the flow, :math:`y' = v\cdot e` with
:math:`e = t \times n`, by `synchronisation`. The lift is perpendicular to the relative flow, so all energy
that it takes from the flow is supplied to the riser. The tangent matrix omits the dependence of loads on the
direction of the pipe, and the dependence of phases on elevation. In motion, both omitted terms are small
compared with inertia.

References
----------
Thorsen, Sævik and Larsen (2014), "A simplified method for time domain simulation of cross-flow
vortex-induced vibrations", *Journal of Fluids and Structures* 49, 135-148.
"""

from __future__ import annotations

from math import cos, sin
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register, taken_out
from riserstudy.effects.synchronisation import PHASE, STILL, VARIABLES, grown, past, rest, synchronise
from riserstudy.solve.jit import inner
from riserstudy.solve.spread import spread_and_keep, spread_stiffness, supplied
from riserstudy.solve.state import ACCELERATION, OTHER, OWN, VELOCITY
from riserstudy.solve.vec import add, at, cross, dot, mul, outer, put, put_block, sub, upward

#: includes lift and excitation in line with the flow, which are in the same section of a scene
EXAMPLE = {
    "riser[0].viv": {"model": "synchronisation", "diameter": "0.5 m", "coefficient": 1.2}
    | {"frequencies": [0.11, 0.18, 0.26], "memory": 20.0, "seed": 1, "ramp": "0.1 s"}
    | {"in_line": {"coefficient": 0.5, "frequencies": [0.22, 0.36, 0.52]}}
}


class VortexLift(NamedTuple):
    """Lift of the segments that shed vortices."""

    low: np.ndarray  # (n,) rho C_v D / 2 times length, as it loads the lower node (kg/m)
    up: np.ndarray  # (n,) as it loads the upper node
    force: np.ndarray  # (d, n+1) scratch: lift on the nodes (N)
    diameter: np.ndarray  # (n+1,) D at the nodes (m), 0 where nothing is shed
    shedding: np.ndarray  # (4, n+1) f_0, f_0 - f_min, f_max - f_0, T (1)
    ramp: float  # time over which the lift increases to its full value (s)
    first: int  # row of the phases among the internal variables
    follow: np.ndarray  # (3, n+1) scratch: phase by velocity along e, along n, by acceleration along e


@inner
def internal(lift, s):
    """Phases and mean squares of the nodes, their rates, and the derivatives of the phases by the motion."""
    for i in range(s.l0.shape[0] + 1):
        for k in range(VARIABLES):
            lift.follow[k, i] = 0.0
        u, speed = past(s, i)
        if lift.diameter[i] > 0.0 and speed > STILL:
            _shed(lift, s, i, mul(1.0 / speed, u), speed)
        else:
            rest(lift, s, i)
    return 0.0


@inner
def _shed(lift, s, i, n, speed):
    """The computation of `internal` at one node, with a relative flow along ``n``."""
    e = cross(at(s.dim, s.direction, i), n)
    v, a = at(s.dim, s.v, i), at(s.dim, s.a, i)
    by_v, by_a, by_speed = synchronise(lift, s, i, speed, dot(v, e), dot(a, e))
    # dy_v = (1 + v.n / speed) (e.dv), dy_a = e.da + (a.n / speed) (e.dv), d speed = -n.dv
    stretch, lean = 1.0 + dot(v, n) / speed, dot(a, n) / speed
    lift.follow[0, i] = by_v * stretch + by_a * lean
    lift.follow[1, i] = -by_speed
    lift.follow[2, i] = by_a
    return 0.0


@inner
def force(lift, s):
    """Lift on the nodes."""
    acts = grown(lift, s)
    for i in range(s.l0.shape[0] + 1):
        u, speed = past(s, i)
        size = acts * speed * cos(s.internal[lift.first + PHASE, i])
        put(s.density, i, mul(size, cross(at(s.dim, s.direction, i), u)))
    spread_and_keep(s, lift.low, lift.up, OWN, OTHER, s.density, lift.force, s.force)
    return 0.0


@inner
def tangent(lift, s):
    """Derivative by velocity and acceleration, phases included, and by elevation in a sheared flow."""
    acts, up = grown(lift, s), upward(s.dim)
    if acts == 0.0:
        return 0.0
    by_v, by_a = s.rate[VELOCITY], s.rate[ACCELERATION]
    for i in range(s.l0.shape[0] + 1):
        u, speed = past(s, i)
        t = at(s.dim, s.direction, i)
        n = mul(1.0 / max(speed, STILL), u)
        e = cross(t, n)
        phase, h = s.internal[lift.first + PHASE, i], at(s.dim, s.shear, i)
        c, sine = acts * speed * cos(phase), acts * speed * speed * sin(phase)
        across = sub(mul(2.0 * by_v * c, outer(e, n)), mul(by_v * c, outer(n, e)))
        by_height = sub(mul(2.0 * c * dot(n, h), e), mul(c * dot(e, h), n))
        follows = add(
            mul(by_v * lift.follow[0, i] + by_a * lift.follow[2, i], e), mul(by_v * lift.follow[1, i], n)
        )
        block = add(across, mul(sine, outer(e, follows)))
        put_block(s.block, i, sub(block, outer(by_height, up)))
    spread_stiffness(s, lift.low, lift.up, OWN, OTHER)
    return 0.0


register(
    VortexLift,
    Called(
        "vortex-induced vibration",
        "riser.viv",
        (taken_out("vortex-induced vibration", "riser[*].viv", "lateral"),),
        example=EXAMPLE,
    ),
    string=force,
    internal=internal,
    tangent=tangent,
    power=supplied,
)
