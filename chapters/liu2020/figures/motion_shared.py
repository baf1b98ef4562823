"""Labels and functions that several figures share."""

from __future__ import annotations

import xarray as xr

from chapters.liu2020.below_ring import RING

DEPTH, TIME = "depth below the riser's top (m)", "time (s)"


def by_depth(values: xr.DataArray) -> xr.DataArray:
    """Replace the arclength from the riser's bottom by the depth below its top."""
    depth = (RING - values["s"]).round(6)
    return values.assign_coords(depth=depth).swap_dims(s="depth").sortby("depth")
