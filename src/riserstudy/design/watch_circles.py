"""Watch circles: the offset at which an alarm must be given for the riser to be off before a limit."""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.dataset.crossing import at_time

#: what a watch circle can be, by its flag
NEVER, TOO_LATE, CIRCLE = 0, 1, 2
MEANINGS = "no_limit_is_reached even_an_alarm_at_the_start_is_too_late circle"


def watch_circle(
    first: xr.DataArray, offset: xr.DataArray, before: xr.DataArray | float
) -> xr.Dataset:
    """Offset at which a disconnect must start to be over when the first limit is reached.

    Parameters
    ----------
    first : time at which the first limit is reached (s), infinite if never.
    offset : the platform's way off the well over ``time`` (m).
    before : time that the emergency disconnect takes, with what must come before it (s).

    Returns
    -------
    ``circle_outcome`` (flag, see MEANINGS) and ``circle_radius`` (m), which is 0 where an alarm at the
    very start would be too late, and the largest offset where no limit is reached at all.
    """
    latest = first - before
    outcome = xr.where(np.isinf(first), NEVER, xr.where(latest > 0.0, CIRCLE, TOO_LATE))
    radius = at_time(offset, latest.where(latest > 0.0, 0.0))
    radius = xr.where(outcome == NEVER, offset.max("time"), radius)
    return xr.Dataset(
        {
            "circle_outcome": outcome.astype(np.int8),
            "circle_radius": radius.where(outcome != TOO_LATE, 0.0),
        }
    )
