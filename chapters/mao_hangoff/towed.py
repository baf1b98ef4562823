"""A riser towed by its top: where it is, seen from there."""

from __future__ import annotations

import xarray as xr


def displacement(runs: xr.Dataset) -> xr.DataArray:
    """Position along the track, from the top (m); negative behind it."""
    top = at_top(runs["x"])
    ahead = xr.where(top.isel(time=-1) < top.isel(time=0), -1.0, 1.0)
    relative: xr.DataArray = (runs["x"] - top) * ahead
    return relative


def at_top(values: xr.DataArray, nodes: str = "s") -> xr.DataArray:
    """Values at the last node that each riser has, over all times."""
    there = values.notnull().any([dim for dim in ("time",) if dim in values.dims])
    last = there.cumsum(nodes).argmax(nodes)
    return values.isel({nodes: last}).drop_vars(nodes)
