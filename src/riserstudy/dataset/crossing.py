"""Where a curve first reaches a level, what reaches it first, and what else is there then."""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.dataset.place_of_crossing import place_of_crossing


def first_crossing(curve: xr.DataArray, level: float, along: str = "time") -> xr.DataArray:
    """Coordinate at which a curve first reaches a level, in the coordinate's unit; infinite if never.

    Straight between points; not a number where it is not known, see ``place_of_crossing``. The level is in
    the unit of the curve.
    """
    place = curve[along].values
    times: xr.DataArray = xr.apply_ufunc(
        lambda c: place_of_crossing(c, level, place),
        curve,
        input_core_dims=[[along]],
        vectorize=True,
    )
    return times


def first_limit(times: xr.DataArray) -> xr.DataArray:
    """Name of the limit that is reached first; "none" where none is, "unknown" where a value is missing.

    ``times`` over ``limit`` and more, infinite where it is never reached.
    """
    known = times.fillna(np.inf)  # so that a name is found; the last line makes it unknown
    names = times["limit"].astype(object).isel(limit=known.argmin("limit")).drop_vars("limit")
    names = names.where(np.isfinite(known.min("limit")), "none")
    return names.where(times.notnull().all("limit"), "unknown").astype(str)


def at_time(history: xr.DataArray, time: xr.DataArray) -> xr.DataArray:
    """Value of a history at times that may differ from run to run; its end value after its end."""
    within = time.clip(float(history["time"][0]), float(history["time"][-1]))
    values: xr.DataArray = xr.apply_ufunc(
        lambda h, t: np.interp(t, history["time"].values, h),
        history,
        within,
        input_core_dims=[["time"], []],
        vectorize=True,
    )
    return values
