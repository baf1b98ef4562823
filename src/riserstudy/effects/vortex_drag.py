r"""Vortex-induced vibration in line with the flow: varying drag, synchronised with the riser's motion.

Vortices are shed alternately from both sides of a pipe, so the drag varies twice in each period of the
lift. With the velocity u of the water relative to the pipe and across it, the force per unstretched length
is

.. math:: f = \tfrac12 \rho\,C_x D\,|u|\,u\cos\varphi_x

This force acts in addition to the mean drag. The phase :math:`\varphi_x` follows the velocity of the riser
along the flow, :math:`v\cdot u/|u|`, by `synchronisation`, with three separate frequencies of about twice the
frequencies of the lift. The phase of the varying drag is independent of the phase of the lift.

As for the lift, the tangent matrix omits the dependence of loads on the direction of the pipe, and the
dependence of phases on elevation.

References
----------
Ulveseter, Sævik and Larsen (2017), "Time domain model for calculation of pure in-line vortex-induced
vibrations", *Journal of Fluids and Structures* 68, 158-173: the time-varying drag whose phase synchronises
with the in-line vibration. Their model has two frequency ranges, with coefficients that depend on amplitude.
This model has one range and one coefficient.
"""

from __future__ import annotations

from math import cos, sin
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register, taken_out
from riserstudy.effects.synchronisation import PHASE, STILL, VARIABLES, grown, past, rest, synchronise
from riserstudy.effects.vortex_lift import EXAMPLE
from riserstudy.solve.jit import inner
from riserstudy.solve.spread import spread_and_keep, spread_stiffness, supplied
from riserstudy.solve.state import ACCELERATION, OTHER, OWN, VELOCITY
from riserstudy.solve.vec import add, at, cross, dot, mul, outer, put, put_block, sub, upward


class VortexDrag(NamedTuple):
    """Varying drag of the segments that shed vortices."""

    low: np.ndarray  # (n,) rho C_x D / 2 times length, as it loads the lower node (kg/m)
    up: np.ndarray  # (n,) as it loads the upper node
    force: np.ndarray  # (d, n+1) scratch: force on the nodes (N)
    diameter: np.ndarray  # (n+1,) D at the nodes (m), 0 where nothing is shed
    shedding: np.ndarray  # (4, n+1) f_0, f_0 - f_min, f_max - f_0, T (1)
    ramp: float  # time over which the force increases to its full value (s)
    first: int  # row of the phases among the internal variables
    follow: np.ndarray  # (3, n+1) scratch: phase by velocity along n, along e, by acceleration along n


@inner
def internal(vortices, s):
    """Phases and mean squares of the nodes, their rates, and the derivatives of the phases by the motion."""
    for i in range(s.l0.shape[0] + 1):
        for k in range(VARIABLES):
            vortices.follow[k, i] = 0.0
        u, speed = past(s, i)
        if vortices.diameter[i] > 0.0 and speed > STILL:
            _shed(vortices, s, i, mul(1.0 / speed, u), speed)
        else:
            rest(vortices, s, i)
    return 0.0


@inner
def _shed(vortices, s, i, n, speed):
    """The computation of `internal` at one node, with a relative flow along ``n``."""
    e = cross(at(s.dim, s.direction, i), n)
    v, a = at(s.dim, s.v, i), at(s.dim, s.a, i)
    by_v, by_a, by_speed = synchronise(vortices, s, i, speed, dot(v, n), dot(a, n))
    # dy_v = n.dv - (v.e / speed) (e.dv), dy_a = n.da - (a.e / speed) (e.dv), d speed = -n.dv
    vortices.follow[0, i] = by_v - by_speed
    vortices.follow[1, i] = -(by_v * dot(v, e) + by_a * dot(a, e)) / speed
    vortices.follow[2, i] = by_a
    return 0.0


@inner
def force(vortices, s):
    """Force on the nodes."""
    acts = grown(vortices, s)
    for i in range(s.l0.shape[0] + 1):
        u, speed = past(s, i)
        put(s.density, i, mul(acts * speed * cos(s.internal[vortices.first + PHASE, i]), u))
    spread_and_keep(s, vortices.low, vortices.up, OWN, OTHER, s.density, vortices.force, s.force)
    return 0.0


@inner
def tangent(vortices, s):
    """Derivative by velocity and acceleration, phases included, and by elevation in a sheared flow."""
    acts, up = grown(vortices, s), upward(s.dim)
    if acts == 0.0:
        return 0.0
    by_v, by_a = s.rate[VELOCITY], s.rate[ACCELERATION]
    for i in range(s.l0.shape[0] + 1):
        u, speed = past(s, i)
        n = mul(1.0 / max(speed, STILL), u)
        e = cross(at(s.dim, s.direction, i), n)
        phase, h = s.internal[vortices.first + PHASE, i], at(s.dim, s.shear, i)
        c, sine = acts * speed * cos(phase), acts * speed * speed * sin(phase)
        along = add(mul(2.0 * by_v * c, outer(n, n)), mul(by_v * c, outer(e, e)))
        by_height = add(mul(2.0 * c * dot(n, h), n), mul(c * dot(e, h), e))
        follows = add(
            mul(by_v * vortices.follow[0, i] + by_a * vortices.follow[2, i], n),
            mul(by_v * vortices.follow[1, i], e),
        )
        block = add(along, mul(sine, outer(n, follows)))
        put_block(s.block, i, sub(block, outer(by_height, up)))
    spread_stiffness(s, vortices.low, vortices.up, OWN, OTHER)
    return 0.0


register(
    VortexDrag,
    Called(
        "in-line vortex-induced vibration",
        "riser.viv.in_line",
        (taken_out("in-line vortex-induced vibration", "riser[*].viv.in_line", "lateral"),),
        example=EXAMPLE,
    ),
    string=force,
    internal=internal,
    tangent=tangent,
    power=supplied,
)
