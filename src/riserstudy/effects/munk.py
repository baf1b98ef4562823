r"""Munk moment: added inertia of a hull that is free to yaw in a current.

The added mass A moves relative to the water, which moves with the velocity U. Lagrange's equations of the
kinetic energy :math:`\tfrac12 (\dot r - U)^T A(\psi) (\dot r - U)`, minus Lagrange's equations of the hull in
water at rest, give

.. math::

   F = \dot\psi A' U,\qquad N = \tfrac12 U^T A' U - \dot r^T A' U,\qquad V = -\tfrac12 U^T A U

Here :math:`A'` is :math:`dA/d\psi`. A hull with a larger added mass sideways turns broadside to the current
(Munk moment). The work of forces and moment equals the decrease of the potential V.

References
----------
Munk (1924), "The aerodynamic forces on airship hulls", *NACA Report* 184. Elementary: Lagrange's equations.
"""

from __future__ import annotations

from math import pi
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.effects.vessel import attitude, twisted, velocity
from riserstudy.solve.jit import inner
from riserstudy.solve.state import VELOCITY

# each derivative of the tensor by yaw is twice the previous one, with yaw + pi / 4
QUARTER = 0.25 * pi


class Munk(NamedTuple):
    """A hull in a current."""

    node: int
    yaw: int  # loose node with the arc of the yaw in its last direction
    radius: float  # of the arc (m)
    heading: float  # of the hull at rest (rad)
    difference: float  # added mass along the hull minus added mass across it (kg)
    current: np.ndarray  # (2,) surface current in x and y (m/s)


@inner
def _halfway(munk, s):
    """Half of the current's velocity minus the platform's velocity."""
    v = velocity(munk, s)
    return 0.5 * munk.current[0] - v[0], 0.5 * munk.current[1] - v[1]


@inner
def force(munk, s):
    """Force on the platform, moment on its yaw."""
    up = len(s.dim) - 1
    angle, rate = attitude(munk, s)
    twist = twisted(munk.difference, angle, munk.current)
    for k in range(up):
        s.force[k, munk.node] += rate * twist[k]
    u = _halfway(munk, s)
    s.force[up, munk.yaw] += (u[0] * twist[0] + u[1] * twist[1]) / munk.radius
    return 0.0


@inner
def tangent(munk, s):
    """Derivative with respect to yaw and the velocities."""
    d, up, i = len(s.dim), len(s.dim) - 1, munk.node
    angle, rate = attitude(munk, s)
    twist = twisted(munk.difference, angle, munk.current)
    bent = twisted(2.0 * munk.difference, angle + QUARTER, munk.current)
    u = _halfway(munk, s)
    for k in range(up):
        s.k_up[i, k * d + up] -= (rate * bent[k] + s.rate[VELOCITY] * twist[k]) / munk.radius
        s.k_low[i, up * d + k] += s.rate[VELOCITY] * twist[k] / munk.radius
    s.k_node[munk.yaw, d * d - 1] -= (u[0] * bent[0] + u[1] * bent[1]) / munk.radius**2
    return 0.0


@inner
def energy(munk, s):
    """Potential energy of the hull in the current (J), except for a constant."""
    angle, _ = attitude(munk, s)
    a, b = munk.current[0], munk.current[1]
    twist = twisted(munk.difference, angle - QUARTER, munk.current)
    return -0.25 * (a * twist[0] + b * twist[1])


register(
    Munk, Called("Munk moment", "vessel.yaw, and a current"), device=force, tangent=tangent, potential=energy
)
