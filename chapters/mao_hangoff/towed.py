"""A riser towed by its top: positions relative to the top."""

from __future__ import annotations

import xarray as xr


def displacement(runs: xr.Dataset) -> xr.DataArray:
    """Position along the track, relative to the top (m); negative behind the top."""
    top = at_top(runs["x"])
    ahead = xr.where(top.isel(time=-1) < top.isel(time=0), -1.0, 1.0)
    relative: xr.DataArray = (runs["x"] - top) * ahead
    return relative


def at_top(values: xr.DataArray, nodes: str = "s") -> xr.DataArray:
    """Values at the uppermost node of each riser: its last node with a value at any time."""
    there = values.notnull().any([dim for dim in ("time",) if dim in values.dims])
    last = there.cumsum(nodes).argmax(nodes)
    return values.isel({nodes: last}).drop_vars(nodes)
