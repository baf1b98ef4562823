"""Where a curve first reaches a level."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def place_of_crossing(
    curve: NDArray[np.float64], level: float, place: NDArray[np.float64]
) -> float:
    """Place at which a curve first reaches a level, straight between points; infinite if never.

    Parameters
    ----------
    curve, place : (n,); the level is in the unit of the curve.
    """
    over = np.flatnonzero(curve >= level)
    if len(over) == 0:
        return np.inf
    k = int(over[0])
    if k == 0:
        return float(place[0])
    share = (level - curve[k - 1]) / (curve[k] - curve[k - 1])
    return float(place[k - 1] + share * (place[k] - place[k - 1]))
