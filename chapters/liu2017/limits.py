"""Limits of a connected riser (Liu et al. 2017, section 3), and the used share of each.

The paper names six limits and gives five values. The sixth, the strength of the riser itself, is evaluated
separately, under the assumption that it equals the conductor's strength.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from riserstudy.dataset.crossing import first_crossing


class Limit(NamedTuple):
    """A variable and the absolute value that it must not exceed, in SI units."""

    variable: str
    most: float


LIMITS = {
    "upper flex joint": Limit("ufj_angle", float(np.deg2rad(12.0))),
    "lower flex joint": Limit("lfj_angle", float(np.deg2rad(6.0))),
    "telescopic joint": Limit("stroke", 9.905),
    "conductor": Limit("conductor_stress", 386e6),
    "wellhead": Limit("wellhead_moment", 7.8e6),
}


#: parts at the bottom
BOTTOM = ("lower flex joint", "conductor", "wellhead")
#: change, as a share of the limit, at which a quantity counts as having begun to respond: larger than the
#: change of the upper flex joint angle by the wave
START = 0.05


def shares(runs: xr.Dataset) -> xr.DataArray:
    """Share of each limit that is used, over ``limit`` and the dimensions of the runs."""
    return abs(_used(runs)).rename("limit_share")


def reached(runs: xr.Dataset) -> xr.DataArray:
    """Time (s) at which each limit is reached, infinite if never."""
    return first_crossing(shares(runs), 1.0)


def starts(runs: xr.Dataset, share: float = START) -> xr.DataArray:
    """Time at which each quantity has changed by a share of its limit since the start (s), or infinity."""
    used = _used(runs)
    return first_crossing(abs(used - used.isel(time=0, drop=True)), share)


def _used(runs: xr.Dataset) -> xr.DataArray:
    """Quantities divided by their limits, with their signs, over ``limit`` and the dimensions of the runs."""
    used = [runs[limit.variable] / limit.most for limit in LIMITS.values()]
    labels = xr.DataArray(list(LIMITS), dims="limit", name="limit")
    return xr.concat(used, labels, coords="minimal", compat="override")
