"""Largest and smallest values of histories: outputs miss the peaks of the riser's free oscillation.

Its period is 2.6 s, and outputs of samples are 0.25 s apart.
"""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.dataset.statistics import finer
from riserstudy.records.arrays import FloatArray


def extremes(history: xr.DataArray) -> tuple[xr.DataArray, xr.DataArray]:
    """Largest and smallest value over ``time`` at and between outputs; histories may end early."""

    def of(values: FloatArray) -> tuple[float, float]:
        known = values[~np.isnan(values)]
        if not known.size:
            return np.nan, np.nan
        dense = finer(known)
        return float(dense.max()), float(dense.min())

    high, low = xr.apply_ufunc(
        of, history, input_core_dims=[["time"]], output_core_dims=[[], []], vectorize=True
    )
    return high, low
