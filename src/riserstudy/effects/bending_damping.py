r"""Bending structural damping, proportional to the rate of curvature (Kelvin-Voigt).

.. math:: M = EI\,(\kappa + \tau\,\dot\kappa)

so that the moments belong to the turning angles plus :math:`\tau` times their rates.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import register
from riserstudy.solve.blocktri import flexibility_solve
from riserstudy.solve.jit import inner
from riserstudy.solve.state import DISSIPATED, VELOCITY


class BendingDamping(NamedTuple):
    """Relaxation of the pipe in bending."""

    time: float  # tau (s)
    rate: np.ndarray  # (n+1,) scratch: turning rate at the nodes (rad/s)
    moment: np.ndarray  # (n+1,) scratch: viscous part of the moments (N m)


@inner
def _segment_rate(s, e):
    """Angular velocity of a segment (rad/s)."""
    t, v, inverse = s.tangent, s.v, s.inverse_length[e]
    return inverse * (t[1, e] * (v[0, e + 1] - v[0, e]) - t[0, e] * (v[1, e + 1] - v[1, e]))


@inner
def turn(damping, s):
    """Turning angles grow by tau times their rates."""
    for e in range(s.l0.shape[0]):
        extra = damping.time * _segment_rate(s, e)
        s.turn[0, e] += extra
        s.turn[0, e + 1] -= extra
    return 0.0


@inner
def tangent(damping, s):
    """Derivative of the rates by velocity and by the direction of the segment."""
    t, v = s.tangent, s.v
    for e in range(s.l0.shape[0]):
        x, z, inverse = t[0, e], t[1, e], s.inverse_length[e]
        vx, vz = v[0, e + 1] - v[0, e], v[1, e + 1] - v[1, e]
        cross, square = -2.0 * x * z, x * x - z * z
        rate, area = s.rate[VELOCITY] * inverse, inverse * inverse
        by_x = damping.time * (rate * z + (cross * vx + square * vz) * area)
        by_z = damping.time * (-rate * x + (square * vx - cross * vz) * area)
        s.turn_low[e, 0] += by_x
        s.turn_low[e, 1] += by_z
        s.turn_up[e, 0] -= by_x
        s.turn_up[e, 1] -= by_z
    return 0.0


@inner
def _viscous_moments(damping, s):
    """Part of the moments that the rates cause: the flexibility matrix solved for tau times rate."""
    rate, moment = damping.rate, damping.moment
    rate[:] = 0.0
    for e in range(s.l0.shape[0]):
        swing = _segment_rate(s, e)
        rate[e] += swing
        rate[e + 1] -= swing
    for i in range(rate.shape[0]):
        moment[i] = damping.time * rate[i]
    flexibility_solve(s, moment)


@inner
def energy(damping, s):
    """What the strain energy of the total moments holds too much: they are partly viscous (J)."""
    _viscous_moments(damping, s)
    total = 0.0
    for i in range(s.l0.shape[0] + 1):
        angle = damping.time * damping.rate[i]
        total += angle * (0.5 * damping.moment[i] - s.moment[0, i])
    return total


@inner
def power(damping, s):
    """Power dissipated (W)."""
    _viscous_moments(damping, s)
    for i in range(s.l0.shape[0] + 1):
        s.flow[DISSIPATED] += damping.moment[i] * damping.rate[i]
    return 0.0


register(BendingDamping, turn=turn, tangent=tangent, potential=energy, power=power)
