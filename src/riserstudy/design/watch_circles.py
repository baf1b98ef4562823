"""Watch circles: the offset at which an alarm must be given to disconnect before a limit is reached."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr

from riserstudy.dataset.crossing import at_time
from riserstudy.scene.units import to_si

#: outcomes of a watch circle, as flags
NEVER, TOO_LATE, CIRCLE, UNKNOWN = CODES = range(4)
MEANINGS = "no_limit_is_reached even_an_alarm_at_the_start_is_too_late circle not_known"
FLAGS = {"flag_values": np.array(CODES, np.int8), "flag_meanings": MEANINGS}


def watch_circle(first: xr.DataArray, offset: xr.DataArray, before: xr.DataArray | float) -> xr.Dataset:
    """Offset at which a disconnect must start in order to end when the first limit is reached.

    Parameters
    ----------
    first : time at which the first limit is reached (s), infinite if never, NaN if it is not known.
    offset : distance of the platform from the well over ``time`` (m).
    before : duration of the emergency disconnect, and of the actions before it (s).

    Returns
    -------
    ``circle_outcome`` (flag, see MEANINGS) and ``circle_radius`` (m). The radius is 0 if an alarm at the very
    start would be too late, the largest offset if no limit is reached, and NaN if the first limit is not
    known.
    """
    latest = first - before
    outcome = xr.where(np.isinf(first), NEVER, xr.where(latest > 0.0, CIRCLE, TOO_LATE))
    outcome = xr.where(np.isnan(first), UNKNOWN, outcome)
    radius = xr.where(outcome == NEVER, offset.max("time"), at_time(offset, latest))
    return xr.Dataset(
        {
            "circle_outcome": outcome.astype(np.int8),
            "circle_radius": radius.where(outcome != TOO_LATE, 0.0).where(outcome != UNKNOWN),
        }
    )


def red_and_yellow(
    first: xr.DataArray, offset: xr.DataArray, eds_times: Sequence[str], preparing: str
) -> xr.Dataset:
    """Both watch circles over ``eds_time`` (s), variables of ``watch_circle`` after ``red_`` and ``yellow_``.

    Parameters
    ----------
    first, offset : as in ``watch_circle``.
    eds_times : durations of the emergency disconnect from the red alarm on, with units.
    preparing : time from the yellow alarm to the red alarm, with its unit.
    """
    seconds = [to_si(time, "s") for time in eds_times]
    eds = xr.DataArray(seconds, dims="eds_time", coords={"eds_time": seconds})
    circles = {
        "red": watch_circle(first, offset, eds),
        "yellow": watch_circle(first, offset, eds + to_si(preparing, "s")),
    }
    return xr.Dataset({f"{c}_{n}": values for c, of in circles.items() for n, values in of.items()})


def with_flags(circles: xr.Dataset) -> xr.Dataset:
    """The dataset with the meanings of the flags in the attributes of each outcome."""
    for name in circles:
        if str(name).endswith("circle_outcome"):
            circles[name].attrs |= FLAGS
    return circles
