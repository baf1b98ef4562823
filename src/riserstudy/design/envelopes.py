"""The envelope of a mode: offsets between which all of its limits are met, and the limits that govern."""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.dataset.limits import PARTS

SIDES = ("low", "high")
NONE = "none"


def envelopes(limits: xr.DataArray) -> xr.Dataset:
    """Offsets between which all limits of a mode are met, and the limit that governs each side.

    NaN if they are met at no offset. ``limits``: offsets over ``limit``, with its `coordinates`.
    """
    modes = limits["mode_of_limit"].values
    parts = []
    for mode in dict.fromkeys(modes.tolist()):
        of = limits.isel(limit=modes == mode)
        low, high = of.sel(offset_side="low"), of.sel(offset_side="high")
        ends = {"low": low.max("limit", skipna=False), "high": high.min("limit", skipna=False)}
        open_here = ends["low"] <= ends["high"]
        envelope = xr.concat([ends[side].where(open_here) for side in SIDES], of["offset_side"])
        governs = xr.concat(
            [
                _named(low.argmax("limit", skipna=False), low),
                _named(high.argmin("limit", skipna=False), high),
            ],
            of["offset_side"],
        )
        governs = governs.where(np.isfinite(envelope), NONE)
        part = xr.Dataset({"envelope_offset": envelope, "governing_limit_name": governs})
        parts.append(part.assign_coords(operation=mode))
    return xr.concat(parts, "operation", coords="minimal", compat="override")


def _named(which: xr.DataArray, of: xr.DataArray) -> xr.DataArray:
    names = np.array(words_of(of), object)
    return which.copy(data=names[which.values]).drop_vars("offset_side")


def words_of(limits: xr.DataArray | xr.Dataset) -> list[str]:
    """Side and output of each limit, without its mode."""
    parts = (limits[name].values for name in PARTS[1:])
    return [f"{side} {output}" for side, output in zip(*parts, strict=True)]
