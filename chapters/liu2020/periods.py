"""Amplitudes over the last periods of a history, and their change from period to period.

Outputs miss the peaks between them. Largest and smallest values are those of a spline through the outputs.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from scipy.interpolate import make_interp_spline

from riserstudy.dataset.statistics import BETWEEN, DEGREE
from riserstudy.records.arrays import FloatArray

AROUND = 6  # outputs before and after a period that the spline includes


def half_swing(history: xr.DataArray, period: str | float, back: int = 0) -> xr.DataArray:
    """Half of (largest - smallest) over one period: the last one, or ``back`` periods before it.

    Parameters
    ----------
    history : over ``time`` (s).
    period : a period (s), or a dimension of the history whose values are periods (s).
    """
    if not isinstance(period, str):
        return _half_range(history, period, back)
    parts = [_half_range(history.sel({period: of}), float(of), back) for of in history[period].values]
    return _joined(parts, history, period)


def first_harmonic(history: xr.DataArray, period: str | float) -> xr.DataArray:
    """Complex amplitude of exp(2 pi i t / period) over the last period."""
    if not isinstance(period, str):
        return _harmonic(history, period)
    parts = [_harmonic(history.sel({period: of}), float(of)) for of in history[period].values]
    return _joined(parts, history, period)


def settling(history: xr.DataArray, period: str | float) -> xr.DataArray:
    """Relative change of the amplitude from the second-last period to the last."""
    last, before = half_swing(history, period), half_swing(history, period, back=1)
    return abs(last / before - 1.0)


def beats(history: xr.DataArray, period: str) -> xr.DataArray:
    """Largest amplitude of all whole periods minus the smallest, divided by the largest.

    Zero if all periods are equal. A beat is visible only if the record is at least as long as the beat.

    Parameters
    ----------
    history : over ``time`` (s).
    period : a dimension of the history whose values are periods (s).
    """
    parts = []
    for seconds in history[period].values:
        one = history.sel({period: seconds}, drop=True)
        count = int((float(one["time"][-1]) - float(one["time"][0])) / seconds + 1e-6)
        ranges = [half_swing(one, float(seconds), back) for back in range(count)]
        all_of_them = xr.concat(ranges, "back")
        parts.append(1.0 - all_of_them.min("back") / all_of_them.max("back"))
    return xr.concat(parts, history[period])


def _half_range(history: xr.DataArray, seconds: float, back: int) -> xr.DataArray:
    time = history["time"].values
    end = float(time[-1]) - back * seconds
    start = max(end - seconds, float(time[0]))
    first, last = np.searchsorted(time, [start - 1e-6, end + 1e-6])
    part = history.isel(time=slice(max(first - AROUND, 0), last + AROUND))
    outputs, fine = part["time"].values, np.linspace(start, end, max(2, BETWEEN * (last - first)))
    spline = make_interp_spline(outputs, np.eye(outputs.size), min(DEGREE, outputs.size - 1))
    weights = [spline(some).T for some in np.array_split(fine, BETWEEN)]  # all at once fill the memory

    def half(values: FloatArray) -> FloatArray:
        flat = np.ascontiguousarray(values).reshape(-1, outputs.size)
        high, low = np.full(len(flat), -np.inf), np.full(len(flat), np.inf)
        for some in weights:
            between = flat @ some
            high, low = np.maximum(high, between.max(axis=1)), np.minimum(low, between.min(axis=1))
        of_each: FloatArray = 0.5 * (high - low)
        return of_each.reshape(values.shape[:-1])

    found: xr.DataArray = xr.apply_ufunc(half, part, input_core_dims=[["time"]])
    return found


def _harmonic(history: xr.DataArray, seconds: float) -> xr.DataArray:
    last = history.isel(time=(history["time"] > float(history["time"][-1]) - seconds + 1e-6).values)
    turn = np.exp(-2j * np.pi * last["time"] / seconds)
    return 2.0 * (last * turn).mean("time")


def _joined(parts: list[xr.DataArray], history: xr.DataArray, period: str) -> xr.DataArray:
    joined = xr.concat(parts, history[period])
    return joined.transpose(*(dim for dim in history.dims if dim in joined.dims))
