r"""How far a vessel drifts that has lost its thrust: steady force, current, quadratic drag of the hull.

.. math:: M \dot w = F - C w |w|,\quad w = v - U,\quad v(0) = 0

Until the vessel is as fast as the current this is a tangent, then a hyperbolic tangent, to
:math:`\sqrt{F/C}` beyond it. In still water :math:`x = (M/C) \ln\cosh(\sqrt{F C}\,t/M)`; in a current alone
:math:`v = U k U t/(1 + k U t)`, :math:`k = C/M`.

References
----------
Elementary: Riccati's equation with constant coefficients.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


class Hull(NamedTuple):
    """A vessel adrift."""

    mass: float  # with added mass (kg)
    drag: float  # N s2/m2, by the water's speed past it


class Drift(NamedTuple):
    """Way and speed over time, each of the shape of the times."""

    way: FloatArray  # m
    speed: FloatArray  # m/s


def drift(hull: Hull, force: float, current: float, times: ArrayLike) -> Drift:
    """Drift from rest, down current and wind.

    Parameters
    ----------
    force : of wind and waves (N), not below 0.
    current : speed of the water (m/s), the same way, not below 0.
    times : s, not below 0.

    Raises
    ------
    ValueError
        When force or current point the other way.
    """
    if force < 0.0 or current < 0.0:
        raise ValueError("force and current must be 0 or above and have the same direction")
    t = np.asarray(times, float)
    if force == 0.0:
        lag = 1.0 + current * hull.drag / hull.mass * t
        speed = current - current / lag
        return Drift(current * t - hull.mass / hull.drag * np.log(lag), speed)
    terminal = math.sqrt(force / hull.drag)  # beyond the current
    rate = math.sqrt(force * hull.drag) / hull.mass
    angle = math.atan(current / terminal)
    slower = np.minimum(rate * t, angle)  # until as fast as the current
    faster = np.maximum(rate * t - angle, 0.0)
    past = terminal * (np.tan(slower - angle) + np.tanh(faster))
    scale = hull.mass / hull.drag
    way = scale * (np.log(np.cosh(faster)) - np.log(np.cos(slower - angle) / math.cos(angle)))
    return Drift(current * t + way, current + past)
