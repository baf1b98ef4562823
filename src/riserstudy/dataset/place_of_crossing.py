"""The place at which a curve first reaches a level."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def place_of_crossing(curve: NDArray[np.float64], level: float, place: NDArray[np.float64]) -> float:
    """Place at which a curve first reaches a level, linear between points; infinite if never.

    The curve ends with its last value: missing values after it belong to a shorter run. The place is not
    known, and the result is NaN, if there is no value at all, or if a missing value could have reached the
    level first. ``curve``, ``place``: (n,); the level is in the unit of the curve.
    """
    over = np.flatnonzero(curve >= level)
    present = np.flatnonzero(~np.isnan(curve))
    if len(present) == 0:
        return np.nan
    k = int(over[0] if len(over) else present[-1])
    if np.isnan(curve[:k]).any():
        return np.nan
    if len(over) == 0:
        return np.inf
    if k == 0:
        return float(place[0])
    share = (level - curve[k - 1]) / (curve[k] - curve[k - 1])
    return float(place[k - 1] + share * (place[k] - place[k - 1]))
