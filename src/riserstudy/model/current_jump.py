r"""Jumps of a current over elevation, on a mesh whose nodes see the water where they are.

A load of drag goes with the square of the speed, and its nodes stand for lengths of riser. Over the length h
of the segment around a jump the current is therefore replaced by the one whose load is the mean over h,

.. math:: |\bar u|\,\bar u = (1 - a)\,|u_-|\,u_- + a\,|u_+|\,u_+,\qquad a = \tfrac12 + (z - z_j)/h

between the velocities below and above it. The whole load on a riser at rest then is that of the jump wherever
the nodes are, and its place errs by the square of h; no load jumps while a node passes.

References
----------
None: the project's own, with its error above.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
EDGE = 1e-6  # share of a segment over which a jump at an end of the riser, or beyond it, is spread
SHARES = 0.5 - 0.5 * np.cos(
    np.linspace(0.0, np.pi, 33)
)  # of the way over a jump, close at its ends


def spread(
    z: FloatArray, velocity: FloatArray, width: Callable[[float], float]
) -> tuple[FloatArray, FloatArray]:
    """A table of a current in which no elevation stands twice.

    Parameters
    ----------
    z : (k,) elevations (m), rising, twice at a jump.
    velocity : (parts, k) along one direction, or along x and y (m/s).
    width : length of the segment at an elevation (m).

    Returns
    -------
    z, velocity : the same without jumps, each spread over the length of the segment around it.
    """
    while len(jumps := np.flatnonzero(np.diff(z) == 0.0)):
        z, velocity = _one_spread(z, velocity, int(jumps[0]), width(float(z[jumps[0]])))
    return z, velocity


def within(width: float, at: float, low: float, high: float) -> float:
    """Length over which a jump at an elevation is spread, at most up to the riser's ends (m).

    Beyond these there is no riser that the other part of its load could act on.
    """
    return max(min(width, 2.0 * (at - low), 2.0 * (high - at)), EDGE * width)


def up_to_surface(
    z: FloatArray, velocity: FloatArray, surface: float
) -> tuple[FloatArray, FloatArray]:
    """A table of the water below its surface at rest (m), whose velocity there holds above.

    The loads of a segment that reaches through the surface are those of its wet share. A jump of the current
    at the surface, spread over this segment, would reduce them once more. ``z``: (k,) elevations (m), rising;
    ``velocity``: (parts, k) (m/s).
    """
    below = int(np.searchsorted(z, surface))
    if below == len(z):
        return z, velocity
    if below == 0:
        return z[:1], velocity[:, :1]
    share = (surface - z[below - 1]) / (z[below] - z[below - 1])
    there = (1.0 - share) * velocity[:, below - 1] + share * velocity[:, below]
    return np.append(z[:below], surface), np.column_stack([velocity[:, :below], there])


def _one_spread(
    z: FloatArray, velocity: FloatArray, k: int, width: float
) -> tuple[FloatArray, FloatArray]:
    """The table without its jump between points k and k + 1 of one elevation."""
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
