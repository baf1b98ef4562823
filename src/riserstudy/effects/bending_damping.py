r"""Bending structural damping, proportional to the rate of curvature (Kelvin-Voigt).

.. math:: M = EI\,(\kappa + \tau\,\dot\kappa)

Here :math:`\kappa` is the curvature, and :math:`\tau` the time constant of the damping. The moments therefore
follow from the turning angles plus :math:`\tau` times the rates of these angles. In a plane, moments and
angles are numbers; in space, moments and angles are vectors with three components.

A flex joint at a node is not damped: at this node, the damping acts only on the pipe's share of the turning
angle. The engine assumes that the pipe's share of the turning angle is equal to the pipe's share of the
flexibility of the node. The assumption of equal shares neglects the square of :math:`\tau` times the
frequency. The shorter the segments are, the smaller is the pipe's share.

References
----------
Elementary: Kelvin and Voigt's solid, in bending.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.blocktri import flexibility_solve
from riserstudy.solve.jit import inner
from riserstudy.solve.state import DISSIPATED, VELOCITY
from riserstudy.solve.vec import add, at, cross, mul, outer, plus, plus_block, skew, sub, transposed, within


class BendingDamping(NamedTuple):
    """Relaxation of the pipe in bending."""

    time: np.ndarray  # (n+1,) tau, times the pipe's share of the flexibility of a node (s)
    lower: np.ndarray  # (3, 3) direction held at the lower end, its rates; zeros if it turns freely
    upper: np.ndarray  # (3, 3) the same at the upper end
    rate: np.ndarray  # (m, n+1) scratch: turning rate at the nodes (rad/s)
    moment: np.ndarray  # (m, n+1) scratch: viscous part of the moments (N m)


@inner
def _segment_rate(s, e):
    """Angular velocity of a segment (rad/s)."""
    apart = sub(at(s.dim, s.v, e + 1), at(s.dim, s.v, e))
    return mul(s.inverse_length[e], cross(at(s.dim, s.tangent, e), apart))


@inner
def _held_rate(s, held):
    """Angular velocity of a held direction (rad/s)."""
    return cross(within(s.dim, held, 0), within(s.dim, held, 1))


@inner
def turn(damping, s):
    """Add tau times their rates to the turning angles."""
    time, n = damping.time, s.l0.shape[0]
    for e in range(n):
        swing = _segment_rate(s, e)
        plus(s.turn, e, mul(time[e], swing))
        plus(s.turn, e + 1, mul(-time[e + 1], swing))
    plus(s.turn, 0, mul(-time[0], _held_rate(s, damping.lower)))
    plus(s.turn, n, mul(time[n], _held_rate(s, damping.upper)))
    return 0.0


@inner
def tangent(damping, s):
    """Derivative of the rates with respect to the velocity and the chord of the segment."""
    for e in range(s.l0.shape[0]):
        t, inverse = at(s.dim, s.tangent, e), s.inverse_length[e]
        apart = sub(at(s.dim, s.v, e + 1), at(s.dim, s.v, e))
        by_velocity = mul(s.rate[VELOCITY] * inverse, skew(t))
        turning = add(mul(inverse * inverse, skew(apart)), mul(2.0 * inverse, outer(_segment_rate(s, e), t)))
        slope = transposed(sub(by_velocity, turning))
        plus_block(s.turn_low, e, mul(damping.time[e], slope))
        plus_block(s.turn_up, e, mul(-damping.time[e + 1], slope))
    return 0.0


@inner
def _viscous_moments(damping, s):
    """Viscous part of the moments: the flexibility matrix solved for tau times the rates."""
    rate, moment, n = damping.rate, damping.moment, s.l0.shape[0]
    rate[:] = 0.0
    plus(rate, 0, mul(-1.0, _held_rate(s, damping.lower)))
    plus(rate, n, _held_rate(s, damping.upper))
    for e in range(n):
        swing = _segment_rate(s, e)
        plus(rate, e, swing)
        plus(rate, e + 1, mul(-1.0, swing))
    for u in range(rate.shape[0]):
        for i in range(rate.shape[1]):
            moment[u, i] = damping.time[i] * rate[u, i]
        flexibility_solve(s, moment[u])


@inner
def energy(damping, s):
    """Correction of the strain energy (J), which the total moments overstate: a part of them is viscous."""
    _viscous_moments(damping, s)
    total = 0.0
    for u in range(damping.rate.shape[0]):
        for i in range(s.l0.shape[0] + 1):
            angle = damping.time[i] * damping.rate[u, i]
            total += angle * (0.5 * damping.moment[u, i] - s.moment[u, i])
    return total


@inner
def power(damping, s):
    """Power dissipated (W)."""
    _viscous_moments(damping, s)
    for u in range(damping.rate.shape[0]):
        for i in range(s.l0.shape[0] + 1):
            s.flow[DISSIPATED] += damping.moment[u, i] * damping.rate[u, i]
    return 0.0


register(
    BendingDamping,
    Called("bending damping", "riser.structural_damping", lateral=True),
    turn=turn,
    tangent=tangent,
    potential=energy,
    power=power,
)
