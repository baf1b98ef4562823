r"""Thrusters that hold a platform at a place, or at a heading.

.. math::

   F_c = \mathrm{sat}\big(G\,(x_c(t) - x) - D\,\dot x\big),\qquad \tau \dot F + F = F_c

The equations apply in one direction, or in two directions with a limit on the magnitude of the thrust. The
commanded position increases as :math:`x_c (1 - e^{-t/t_r})`. A lag :math:`\tau` adds one unknown per
direction, in a node that is not part of the riser. The unknown for the lag is the path q of a unit mass that
the force F_c / m drives against a damper,

.. math:: \ddot q + \dot q / \tau = F_c / m,\qquad F = m\,\dot q / \tau ,

The energy of the unit mass is negligible. If the platform has first-order motion, x excludes the first-order
motion: the control responds only to the slow motion.

References
----------
Elementary: proportional and derivative control with a limit, and a lag of first order. Liu et al. (2017)
give the proportional part alone.
"""

from __future__ import annotations

from math import exp, sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner
from riserstudy.solve.state import ACCELERATION, DISSIPATED, SUPPLIED, VELOCITY


class Thrusters(NamedTuple):
    """Thrust on a node in some of its directions."""

    node: int
    first: int  # direction
    count: int  # of directions, 1 or 2
    gain: np.ndarray  # (2, 2) G (N/m)
    damping: np.ndarray  # (2, 2) D (N s/m)
    command: np.ndarray  # (2,) x_c (m)
    rise: float  # t_r (s), 0 for a step
    saturation: float  # largest thrust (N), infinite for none
    lag: float  # tau (s), 0 for none; else the next node's first directions hold q
    mass: float  # m (kg)
    arm: float  # lever arm that converts the reported thrust to a moment (m), 1 for a force
    probe: int  # first of its probes


@inner
def _wanted(thrusters, s):
    """Thrust by the control law, before it is limited."""
    grown = 1.0
    if thrusters.rise > 0.0:
        grown -= exp(-max(s.clock[0], 0.0) / thrusters.rise)
    i, k = thrusters.node, thrusters.first
    away = grown * thrusters.command[0] - (s.r[k, i] - s.carried[0, k])
    v = s.v[k, i] - s.carried[1, k]
    if thrusters.count == 1:
        return thrusters.gain[0, 0] * away - thrusters.damping[0, 0] * v, 0.0
    aside = grown * thrusters.command[1] - (s.r[k + 1, i] - s.carried[0, k + 1])
    w = s.v[k + 1, i] - s.carried[1, k + 1]
    gain, damping = thrusters.gain, thrusters.damping
    return (
        gain[0, 0] * away + gain[0, 1] * aside - damping[0, 0] * v - damping[0, 1] * w,
        gain[1, 0] * away + gain[1, 1] * aside - damping[1, 0] * v - damping[1, 1] * w,
    )


@inner
def _commanded(thrusters, s):
    """Thrust by the control law, limited, and the ratio of limited to unlimited thrust."""
    a, b = _wanted(thrusters, s)
    size = sqrt(a * a + b * b)
    share = thrusters.saturation / size if size > thrusters.saturation else 1.0
    return share * a, share * b, share


@inner
def _acting(thrusters, s):
    """Thrust that acts on the platform."""
    a, b, _ = _commanded(thrusters, s)
    if thrusters.lag == 0.0:
        return a, b
    i, scale = thrusters.node + 1, thrusters.mass / thrusters.lag
    return scale * s.v[0, i], (scale * s.v[1, i] if thrusters.count == 2 else 0.0)


@inner
def force(thrusters, s):
    """Thrust on the platform, and the force on the lag's unit mass."""
    acting = _acting(thrusters, s)
    for k in range(thrusters.count):
        s.force[thrusters.first + k, thrusters.node] += acting[k]
    if thrusters.lag > 0.0:
        a, b, _ = _commanded(thrusters, s)
        commanded = a, b
        for k in range(thrusters.count):
            s.force[k, thrusters.node + 1] += commanded[k] / thrusters.mass
            s.force[k, thrusters.node + 1] -= s.v[k, thrusters.node + 1] / thrusters.lag
    return 0.0


@inner
def _stiffness(thrusters, s, share, a, b, k, q):
    """Minus the derivative of the limited thrust in direction k by position q, velocity terms included."""
    gain, damping, rate = thrusters.gain, thrusters.damping, s.rate[VELOCITY]
    own = gain[k, q] + rate * damping[k, q]
    if share == 1.0:
        return own
    along = a * (gain[0, q] + rate * damping[0, q]) + b * (gain[1, q] + rate * damping[1, q])
    return share * own - share * (b if k else a) * along / thrusters.saturation**2


@inner
def tangent(thrusters, s):
    """Derivative with respect to position and velocity."""
    d, i, first = len(s.dim), thrusters.node, thrusters.first
    a, b, share = _commanded(thrusters, s)
    for k in range(thrusters.count):
        for q in range(thrusters.count):
            stiff = _stiffness(thrusters, s, share, a, b, k, q)
            if thrusters.lag == 0.0:
                s.k_node[i, (first + k) * d + first + q] += stiff
            else:
                s.k_low[i, k * d + first + q] += stiff / thrusters.mass
        if thrusters.lag > 0.0:
            s.k_node[i + 1, k * d + k] += s.rate[VELOCITY] / thrusters.lag
            s.k_up[i, (first + k) * d + k] -= s.rate[VELOCITY] * thrusters.mass / thrusters.lag
    return 0.0


@inner
def inertia(thrusters, s):
    """Inertial force of the lag's unit mass."""
    if thrusters.lag > 0.0:
        for k in range(thrusters.count):
            s.force[k, thrusters.node + 1] -= s.a[k, thrusters.node + 1]
    return 0.0


@inner
def mass(thrusters, s):
    """Unit mass of the lag times d a / d r."""
    if thrusters.lag > 0.0:
        for k in range(thrusters.count):
            s.k_node[thrusters.node + 1, k * len(s.dim) + k] += s.rate[ACCELERATION]
    return 0.0


@inner
def lump(thrusters, s):
    """Mass of the lag's node."""
    if thrusters.lag > 0.0:
        for k in range(thrusters.count):
            s.lump[k * len(s.dim) + k, thrusters.node + 1] += 1.0
    return 0.0


@inner
def kinetic(thrusters, s):
    """Kinetic energy of the lag's unit mass (J)."""
    total = 0.0
    if thrusters.lag > 0.0:
        for k in range(thrusters.count):
            total += 0.5 * s.v[k, thrusters.node + 1] ** 2
    return total


@inner
def power(thrusters, s):
    """Power that the thrust supplies, and that of the lag (W)."""
    acting = _acting(thrusters, s)
    a, b, _ = _commanded(thrusters, s)
    commanded = a, b
    for k in range(thrusters.count):
        s.flow[SUPPLIED] += acting[k] * s.v[thrusters.first + k, thrusters.node]
        if thrusters.lag > 0.0:
            q = s.v[k, thrusters.node + 1]
            s.flow[SUPPLIED] += commanded[k] / thrusters.mass * q
            s.flow[DISSIPATED] += q * q / thrusters.lag
    return 0.0


@inner
def probe(thrusters, s):
    """Report the thrust that acts."""
    acting = _acting(thrusters, s)
    for k in range(thrusters.count):
        s.probe[thrusters.probe + k] = thrusters.arm * acting[k]
    return 0.0


register(
    Thrusters,
    Called("thrusters", "vessel.thrusters"),
    Called("heading control", "vessel.thrusters.yaw"),
    device=force,
    tangent=tangent,
    device_inertia=inertia,
    mass=mass,
    lump=lump,
    kinetic=kinetic,
    power=power,
    probe=probe,
)
