"""The smallest magnitude of a vector over all time steps, also between steps.

A vector that passes near zero between two steps has a magnitude with a sharp minimum, which a parabola
through the magnitudes at the steps can miss by a large amount. Its components are smooth.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from riserstudy.records.arrays import FloatArray

MOST = 200  # number of the smallest minima at steps that are searched between steps
PLACES = np.linspace(-1.0, 1.0, 129)  # searched times about a step, as shares of the interval to that side


def smallest_size(times: FloatArray, vectors: FloatArray) -> tuple[float, float]:
    """Smallest magnitude of a vector, and its time (s), by the parabola of the vector through three steps.

    The parabola is about a step with a minimum of the magnitude. None is across an event, which has two
    values at one time.

    Parameters
    ----------
    times : times of the steps (s), (steps,).
    vectors : vector at the steps, (steps, 3), in any unit.
    """
    sizes = np.linalg.norm(vectors, axis=1)
    least = int(sizes.argmin())
    best = float(sizes[least]), float(times[least])
    if len(times) < 3:
        return best
    before, after = np.diff(times)[:-1], np.diff(times)[1:]
    inner = sizes[1:-1]
    steps = 1 + np.flatnonzero((inner <= sizes[:-2]) & (inner <= sizes[2:]) & (before > 0.0) & (after > 0.0))
    slope, bend = _parabolas(times, vectors, steps)
    longest = np.maximum(before, after)[steps - 1]
    reach = longest * np.linalg.norm(slope, axis=1) + longest**2 * np.linalg.norm(bend, axis=1)
    low = np.flatnonzero(sizes[steps] - reach < best[0])  # only these parabolas can go below the steps
    low = low[np.argsort(sizes[steps[low]])[:MOST]]
    if not len(low):
        return best
    steps, slope, bend = steps[low], slope[low, None], bend[low, None]
    away = np.where(PLACES < 0.0, before[steps - 1, None], after[steps - 1, None]) * PLACES
    along = vectors[steps, None] + away[..., None] * slope + away[..., None] ** 2 * bend
    between = np.linalg.norm(along, axis=2)
    one, place = np.unravel_index(int(between.argmin()), between.shape)
    return min(best, (float(between[one, place]), float(times[steps[one]] + away[one, place])))


def _parabolas(
    times: FloatArray, vectors: FloatArray, steps: NDArray[np.int64]
) -> tuple[FloatArray, FloatArray]:
    """Slopes and half second derivatives, (n, 3), of the parabolas through n steps and their neighbours."""
    before, after = (times[steps] - times[steps - 1])[:, None], (times[steps + 1] - times[steps])[:, None]
    left = (vectors[steps] - vectors[steps - 1]) / before
    right = (vectors[steps + 1] - vectors[steps]) / after
    bend = (right - left) / (before + after)
    return left + bend * before, bend
