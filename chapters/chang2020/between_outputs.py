"""Largest and smallest values of histories: outputs miss the peaks of the riser's free oscillation.

Its period is 2.6 s, and outputs of samples are 0.25 s apart.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from scipy.interpolate import make_interp_spline

from riserstudy.records.arrays import FloatArray

DEGREE = 5  # of the spline through the outputs
BETWEEN = 16  # values of the spline in an interval of outputs


def extremes(history: xr.DataArray) -> tuple[xr.DataArray, xr.DataArray]:
    """Largest and smallest value over ``time`` of a spline through the outputs; histories may end early."""
    time = history["time"].values

    def of(values: FloatArray) -> tuple[float, float]:
        known = ~np.isnan(values)
        count = int(known.sum())
        if not count:
            return np.nan, np.nan
        t, values = time[known], values[known]
        if count > DEGREE:
            fine = np.linspace(t[0], t[-1], BETWEEN * count)
            values = np.concatenate([values, make_interp_spline(t, values, DEGREE)(fine)])
        return float(values.max()), float(values.min())

    high, low = xr.apply_ufunc(
        of, history, input_core_dims=[["time"]], output_core_dims=[[], []], vectorize=True
    )
    return high, low
