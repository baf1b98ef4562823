r"""Drift of a vessel that has lost its thrust, under a steady force, a current and quadratic hull drag.

.. math:: M \dot w = F - C w |w|,\quad w = v - U,\quad v(0) = 0

Until the vessel has the speed of the current, w is a tangent function of time. Then it is a hyperbolic
tangent with the limit :math:`\sqrt{F/C}`. In still water :math:`x = (M/C) \ln\cosh(\sqrt{F C}\,t/M)`; in a
current alone :math:`v = U k U t/(1 + k U t)`, with :math:`k = C/M`.

References
----------
Elementary: Riccati's equation with constant coefficients.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from riserstudy.records.arrays import FloatArray


class Hull(NamedTuple):
    """A vessel adrift."""

    mass: float  # with added mass (kg)
    drag: float  # N s2/m2, for the relative speed of the water


class Drift(NamedTuple):
    """Distance and speed over time, each in the shape of the times."""

    way: FloatArray  # m
    speed: FloatArray  # m/s


def drift(hull: Hull, force: float, current: float, times: ArrayLike) -> Drift:
    """Drift from rest, in the direction of current and wind.

    Raises ValueError when force or current have the opposite direction.

    Parameters
    ----------
    force : force of wind and waves (N), not below 0.
    current : speed of the water (m/s) in the same direction, not below 0.
    times : times (s), not below 0.
    """
    if force < 0.0 or current < 0.0:
        raise ValueError("force and current must be 0 or above and have the same direction")
    t = np.asarray(times, float)
    if force == 0.0:
        lag = 1.0 + current * hull.drag / hull.mass * t
        speed = current - current / lag
        return Drift(current * t - hull.mass / hull.drag * np.log(lag), speed)
    terminal = math.sqrt(force / hull.drag)  # relative to the current
    rate = math.sqrt(force * hull.drag) / hull.mass
    angle = math.atan(current / terminal)
    slower = np.minimum(rate * t, angle)  # until the speed of the current is reached
    faster = np.maximum(rate * t - angle, 0.0)
    past = terminal * (np.tan(slower - angle) + np.tanh(faster))
    scale = hull.mass / hull.drag
    way = scale * (np.log(np.cosh(faster)) - np.log(np.cos(slower - angle) / math.cos(angle)))
    return Drift(current * t + way, current + past)
