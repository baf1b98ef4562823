"""Limits of a connected riser (Liu et al. 2017, section 3), and how much of each is used.

The paper names six limits and gives five values; the riser's own strength, if it is the conductor's, is told
apart.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from riserstudy.chapters.liu2017.crossing import first_crossing


class Limit(NamedTuple):
    """A variable and the size of it that must not be exceeded, in SI."""

    variable: str
    most: float


LIMITS = {
    "upper flex joint": Limit("ufj_angle", float(np.deg2rad(12.0))),
    "lower flex joint": Limit("lfj_angle", float(np.deg2rad(6.0))),
    "telescopic joint": Limit("stroke", 9.905),
    "conductor": Limit("conductor_stress", 386e6),
    "wellhead": Limit("wellhead_moment", 7.8e6),
}


#: what is at the bottom
BOTTOM = ("lower flex joint", "conductor", "wellhead")
#: share of a limit by which a quantity has begun to respond: more than the wave moves the upper flex joint by
START = 0.05


def shares(runs: xr.Dataset) -> xr.DataArray:
    """Share of each limit that is used, over ``limit`` and the dimensions of the runs."""
    used = [abs(runs[limit.variable]) / limit.most for limit in LIMITS.values()]
    labels = xr.DataArray(list(LIMITS), dims="limit", name="limit")
    return xr.concat(used, labels, coords="minimal", compat="override").rename("limit_share")


def reached(runs: xr.Dataset) -> xr.DataArray:
    """Time (s) at which each limit is reached, infinite if never."""
    return first_crossing(shares(runs), 1.0)


def starts(runs: xr.Dataset, share: float = START) -> xr.DataArray:
    """When each quantity has changed by a share of its limit since the start (s), infinite if never."""
    changes = [runs[limit.variable] / limit.most for limit in LIMITS.values()]
    labels = xr.DataArray(list(LIMITS), dims="limit", name="limit")
    used = xr.concat(changes, labels, coords="minimal", compat="override")
    return first_crossing(abs(used - used.isel(time=0, drop=True)), share)


def first_limit(times: xr.DataArray) -> xr.DataArray:
    """Name of the limit that is reached first, "none" where none is."""
    names = times["limit"].astype(object).isel(limit=times.argmin("limit"))
    return names.drop_vars("limit").where(np.isfinite(times.min("limit")), "none").astype(str)


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


#: what a watch circle can be, by its flag
NEVER, TOO_LATE, CIRCLE = 0, 1, 2
MEANINGS = "no_limit_is_reached even_an_alarm_at_the_start_is_too_late circle"


def watch_circle(runs: xr.Dataset, before: xr.DataArray | float) -> xr.Dataset:
    """Offset at which a disconnect must start to be over when the first limit is reached.

    Parameters
    ----------
    before : time that the emergency disconnect takes, with what must come before it (s).

    Returns
    -------
    ``circle_outcome`` (flag, see MEANINGS) and ``circle_radius`` (m), which is 0 where an alarm at the
    very start would be too late, and the largest offset where no limit is reached at all.
    """
    first = reached(runs).min("limit")
    latest = first - before
    outcome = xr.where(np.isinf(first), NEVER, xr.where(latest > 0.0, CIRCLE, TOO_LATE))
    offset = runs["platform_offset"]
    radius = at_time(offset, latest.where(latest > 0.0, 0.0))
    radius = xr.where(outcome == NEVER, offset.max("time"), radius)
    return xr.Dataset(
        {
            "circle_outcome": outcome.astype(np.int8),
            "circle_radius": radius.where(outcome != TOO_LATE, 0.0),
        }
    )
