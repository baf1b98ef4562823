"""When a history first reaches a level."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray


def first_crossing(history: xr.DataArray, level: float | xr.DataArray) -> xr.DataArray:
    """Time (s) at which a history first reaches a level, straight between outputs; infinite if never."""
    time = history["time"].values
    found: xr.DataArray = xr.apply_ufunc(
        lambda h, x: _first(h, x, time),
        history,
        level,
        input_core_dims=[["time"], []],
        vectorize=True,
    )
    return found


def _first(history: NDArray[np.float64], level: float, time: NDArray[np.float64]) -> float:
    over = np.flatnonzero(history >= level)
    if len(over) == 0:
        return np.inf
    k = int(over[0])
    if k == 0:
        return float(time[0])
    share = (level - history[k - 1]) / (history[k] - history[k - 1])
    return float(time[k - 1] + share * (time[k] - time[k - 1]))
