"""The smallest magnitude of a vector over all time steps, also between steps.

A vector that passes near zero between two steps has a magnitude with a sharp minimum, which a parabola
through the magnitudes at the steps can miss by a large amount. Its components are smooth.
"""

from __future__ import annotations

import numpy as np

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
    middle = sizes[1:-1]
    found = np.flatnonzero((middle <= sizes[:-2]) & (middle <= sizes[2:]) & (before > 0.0) & (after > 0.0))
    found = found[np.argsort(middle[found])[:MOST]]
    for k in found.tolist():
        h, j = before[k], after[k]
        left, right = (vectors[k + 1] - vectors[k]) / h, (vectors[k + 2] - vectors[k + 1]) / j
        bend = (right - left) / (h + j)
        slope = left + bend * h
        away = np.where(PLACES < 0.0, h, j) * PLACES
        along = np.linalg.norm(vectors[k + 1] + away[:, None] * slope + away[:, None] ** 2 * bend, axis=1)
        place = int(along.argmin())
        best = min(best, (float(along[place]), float(times[k + 1] + away[place])))
    return best
