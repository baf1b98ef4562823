r"""Jumps of a current over elevation, on a mesh that evaluates the current at its nodes only.

Drag is proportional to the square of the speed, and each node represents a length of riser. Over the length h
of the segment around a jump, the current is therefore replaced by a current whose load is the mean over h,

.. math:: |\bar u|\,\bar u = (1 - a)\,|u_-|\,u_- + a\,|u_+|\,u_+,\qquad a = \tfrac12 + (z - z_j)/h

between the velocities below and above the jump. The total load on a riser at rest is then exact for any
position of the nodes, and the position of the load has an error of order h squared. No load jumps when a node
passes the jump.

References
----------
None: the project's own, with its error above.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
# share of a segment over which a jump at an end of the riser, or beyond the end, is spread
EDGE = 1e-6
# of the way over a jump, close at its ends
SHARES = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 33))


def spread(
    z: FloatArray, velocity: FloatArray, width: Callable[[float], float]
) -> tuple[FloatArray, FloatArray]:
    """A table of a current in which no elevation occurs twice.

    Parameters
    ----------
    z : (k,) elevations (m), rising, twice at a jump.
    velocity : (parts, k) along one direction, or along x and y (m/s).
    width : length of the segment at an elevation (m).

    Returns
    -------
    z, velocity : the table without jumps; each is spread over the length of the segment around it.
    """
    while len(jumps := np.flatnonzero(np.diff(z) == 0.0)):
        z, velocity = _one_spread(z, velocity, int(jumps[0]), width(float(z[jumps[0]])))
    return z, velocity


def within(width: float, at: float, low: float, high: float) -> float:
    """Length over which a jump at an elevation is spread; it does not reach beyond the riser's ends (m).

    Beyond the ends there is no riser on which part of the load could act.
    """
    return max(min(width, 2.0 * (at - low), 2.0 * (high - at)), EDGE * width)


def up_to_surface(z: FloatArray, velocity: FloatArray, surface: float) -> tuple[FloatArray, FloatArray]:
    """The table up to the still-water surface (m); above it, the velocity at the surface applies.

    The loads of a segment that crosses the surface are multiplied by its wet share. A jump of the current at
    the surface, spread over this segment, would reduce these loads a second time. ``z``: (k,) elevations (m),
    rising; ``velocity``: (parts, k) (m/s).
    """
    below = int(np.searchsorted(z, surface))
    if below == len(z):
        return z, velocity
    if below == 0:
        return z[:1], velocity[:, :1]
    share = (surface - z[below - 1]) / (z[below] - z[below - 1])
    there = (1.0 - share) * velocity[:, below - 1] + share * velocity[:, below]
    return np.append(z[:below], surface), np.column_stack([velocity[:, :below], there])


def _one_spread(z: FloatArray, velocity: FloatArray, k: int, width: float) -> tuple[FloatArray, FloatArray]:
    """The table without the jump between points k and k + 1, which have the same elevation."""
    low, high = z[k] - 0.5 * width, z[k] + 0.5 * width
    levels = low + width * SHARES
    below = np.array([np.interp(levels, z[: k + 1], part[: k + 1]) for part in velocity])
    above = np.array([np.interp(levels, z[k + 1 :], part[k + 1 :]) for part in velocity])
    load = (1.0 - SHARES) * _load(below) + SHARES * _load(above)
    size = np.sqrt(np.linalg.norm(load, axis=0))
    mean = load / np.where(size > 0.0, size, 1.0)
    first, last = z < low, z > high
    first[k + 1 :], last[: k + 1] = False, False
    return (
        np.concatenate([z[first], levels, z[last]]),
        np.concatenate([velocity[:, first], mean, velocity[:, last]], axis=1),
    )


def _load(velocity: FloatArray) -> FloatArray:
    """Speed times velocity, to which drag is proportional."""
    return np.asarray(np.linalg.norm(velocity, axis=0) * velocity)
