"""What figures on motion have in common: labels and models."""

from __future__ import annotations

import xarray as xr

RING = 533.0  # m, arclength of the riser's top
DEPTH, TIME = "depth below the riser's top (m)", "time (s)"


def by_depth(values: xr.DataArray) -> xr.DataArray:
    """Over depth below the riser's top instead of arclength from its bottom."""
    depth = (RING - values["s"]).round(6)
    return values.assign_coords(depth=depth).swap_dims(s="depth").sortby("depth")
