"""Amplitudes over the last periods of a history, and their change from period to period."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import xarray as xr


def half_swing(history: xr.DataArray, period: str | float, back: int = 0) -> xr.DataArray:
    """Half of (largest - smallest) over one period: the last one, or ``back`` periods before it.

    Parameters
    ----------
    history : over ``time`` (s).
    period : a period (s), or a dimension of the history whose values are periods (s).
    """
    return _by_period(history, period, back, lambda h, _: 0.5 * (h.max("time") - h.min("time")))


def first_harmonic(history: xr.DataArray, period: str | float) -> xr.DataArray:
    """Complex amplitude of exp(2 pi i t / period) over the last period."""

    def harmonic(part: xr.DataArray, seconds: float) -> xr.DataArray:
        turn = np.exp(-2j * np.pi * part["time"] / seconds)
        return 2.0 * (part * turn).mean("time")

    return _by_period(history, period, 0, harmonic)


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


def _by_period(
    history: xr.DataArray,
    period: str | float,
    back: int,
    measure: Callable[[xr.DataArray, float], xr.DataArray],
) -> xr.DataArray:
    end = float(history["time"][-1])

    def of(part: xr.DataArray, seconds: float) -> xr.DataArray:
        time = part["time"]
        inside = (time > end - (back + 1) * seconds + 1e-6) & (time <= end - back * seconds + 1e-6)
        return measure(part.isel(time=inside.values), seconds)

    if not isinstance(period, str):
        return of(history, period)
    parts = [of(history.sel({period: value}), float(value)) for value in history[period].values]
    joined = xr.concat(parts, history[period])
    return joined.transpose(*(dim for dim in history.dims if dim in joined.dims))
