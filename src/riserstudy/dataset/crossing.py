"""The first crossing of a level by a curve, the first of several limits reached, and values at that time."""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.dataset.place_of_crossing import place_of_crossing


def first_crossing(curve: xr.DataArray, level: float, along: str = "time") -> xr.DataArray:
    """Coordinate at which a curve first reaches a level, in the coordinate's unit; infinite if never.

    Interpolation is linear between points. The result is NaN where it is not known, see
    ``place_of_crossing``. The level is in the unit of the curve.
    """
    place = curve[along].values
    times: xr.DataArray = xr.apply_ufunc(
        lambda c: place_of_crossing(c, level, place), curve, input_core_dims=[[along]], vectorize=True
    )
    return times


def first_limit(times: xr.DataArray) -> xr.DataArray:
    """Name of the limit that is reached first; "none" if none is reached, "unknown" if a value is missing.

    ``times`` has the dimension ``limit`` and others; it is infinite for limits that are never reached.
    """
    known = times.fillna(np.inf)  # so that a name is found; the last line makes it unknown
    names = times["limit"].astype(object).isel(limit=known.argmin("limit")).drop_vars("limit")
    names = names.where(np.isfinite(known.min("limit")), "none")
    return names.where(times.notnull().all("limit"), "unknown").astype(str)


def at_time(history: xr.DataArray, time: xr.DataArray) -> xr.DataArray:
    """Value of a history at times that may differ from run to run; after its end, its last value."""
    values: xr.DataArray = xr.apply_ufunc(
        lambda h, t: np.interp(t, history["time"].values, h),
        history,
        time,
        input_core_dims=[["time"], []],
        vectorize=True,
    )
    return values
