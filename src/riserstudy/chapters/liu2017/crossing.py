"""Where a curve first reaches a level."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray


def first_crossing(curve: xr.DataArray, level: float, along: str = "time") -> xr.DataArray:
    """Coordinate at which a curve first reaches a level, straight between points; infinite if never."""
    place = curve[along].values
    times: xr.DataArray = xr.apply_ufunc(
        lambda c: _first(c, level, place), curve, input_core_dims=[[along]], vectorize=True
    )
    return times


def _first(curve: NDArray[np.float64], level: float, place: NDArray[np.float64]) -> float:
    over = np.flatnonzero(curve >= level)
    if len(over) == 0:
        return np.inf
    k = int(over[0])
    if k == 0:
        return float(place[0])
    share = (level - curve[k - 1]) / (curve[k] - curve[k - 1])
    return float(place[k - 1] + share * (place[k] - place[k - 1]))
