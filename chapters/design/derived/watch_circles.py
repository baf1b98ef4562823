"""Design, watch circles: offsets at which alarms must be given when a vessel without thrust drifts off."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from chapters.design.derived.operability import allowed
from riserstudy.dataset.crossing import first_crossing
from riserstudy.dataset.describe import described, scenes_of
from riserstudy.design.drift import Hull, drift
from riserstudy.design.watch_circles import red_and_yellow, with_flags
from riserstudy.scene.units import to_si

if TYPE_CHECKING:
    from riserstudy.design.operability import Offsets

PAPER = "design"
MODE = "disconnect"
TIMES = np.arange(0.0, 3601.0)  # since the start of the drift (s)


def watch_circles(
    rests: xr.Dataset,
    reach: str,
    allowances: dict[str, str],
    eds_times: list[str],
    preparing: str,
    **hull: Any,
) -> xr.Dataset:
    """Return red and yellow circle down current, over the axes of the risers at rest and the disconnect time.

    The vessel drifts from rest above the well; the restoring force of the riser is neglected.

    Parameters
    ----------
    rests : risers at rest above the well, over ``mud_weight`` and ``surface_speed``.
    reach, allowances : as in ``operability``.
    eds_times : durations of the emergency disconnect, from the red alarm, with units.
    preparing : time from the yellow alarm to the red alarm, with its unit.
    hull : ``mass`` with added mass, ``drag``, and ``force`` of wind and waves, with units.
    """
    from riserstudy.design.operability import offsets  # loads kernels

    own = Hull(to_si(hull["mass"], "kg"), to_si(hull["drag"], "N*s^2/m^2"))
    force = to_si(hull["force"], "N")
    first_offset, way = [], []
    for place, scene in scenes_of(rests):
        limits = [limit for limit in scene.limits or [] if limit.mode == MODE]
        of_mode = scene.replaced(limits=limits)
        found = offsets(of_mode, to_si(reach, "m"), allowed(allowances))
        first_offset.append(_first(found))
        way.append(drift(own, force, place["surface_speed"], TIMES).way)
    over = [str(dim) for dim in rests["point_key"].dims]
    shape = rests["point_key"].shape
    coords = {dim: rests[dim] for dim in over}
    limit = xr.DataArray(np.reshape(first_offset, shape), dims=over, coords=coords)
    offset = xr.DataArray(
        np.reshape(way, (*shape, len(TIMES))), dims=(*over, "time"), coords=coords | {"time": TIMES}
    )
    first = first_crossing(offset - limit, 0.0)
    made = xr.Dataset({"limit_offset": limit, "disconnect_time": first})
    made = made.assign(red_and_yellow(first, offset, eds_times, preparing))
    return with_flags(described(made, PAPER, "watch circles of a vessel without thrust"))


def _first(found: Sequence[Offsets]) -> float:
    """Offset (m) at which a vessel that drifts from the well reaches the first limit; NaN if not known.

    It is zero if a limit is exceeded above the well, also if it is met further down current.
    """
    if any(one.missing for one in found):
        return math.nan
    if not all(one.low <= 0.0 <= one.high for one in found):
        return 0.0
    return min((one.high for one in found), default=math.inf)
