"""Design, operability: offsets at which limits are reached, the envelope of a mode, and what governs it."""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.dataset.describe import described, scenes_of
from riserstudy.dataset.limits import label
from riserstudy.scene.limits import UNITS
from riserstudy.scene.units import to_si

PAPER = "design"
SIDES = ("low", "high")
NONE = "none"


def operability(rests: xr.Dataset, reach: str, allowances: dict[str, str]) -> xr.Dataset:
    """Offsets between which each limit is kept, over the axes of the risers at rest.

    Parameters
    ----------
    rests : risers at rest above the well.
    reach : how far to either side is looked, with its unit.
    allowances : dynamic allowance by output, with its unit.
    """
    from riserstudy.design.operability import offsets  # which loads kernels

    found, labels = [], []
    for _, scene in scenes_of(rests):
        labels = [label(limit) for limit in scene.limits or []]
        found.append([each[:2] for each in offsets(scene, to_si(reach, "m"), allowed(allowances))])
    over = [str(dim) for dim in rests["point_key"].dims]
    values = np.array(found).reshape(*rests["point_key"].shape, len(labels), len(SIDES))
    coords = {dim: rests[dim] for dim in over}
    limits = xr.DataArray(
        values,
        dims=(*over, "limit", "offset_side"),
        coords=coords | {"limit": labels, "offset_side": list(SIDES)},
    )
    made = xr.Dataset({"offset_of_limit": limits}).merge(envelopes(limits))
    made.attrs["reach"] = to_si(reach, "m")
    kept = dict(made.attrs)
    return described(made, PAPER, "offsets at which limits are reached").assign_attrs(kept)


def allowed(allowances: dict[str, str]) -> dict[str, float]:
    """Dynamic allowances in the SI units of their limits, from those with units."""
    return {name: to_si(str(value), UNITS[name]) for name, value in allowances.items()}


def envelopes(limits: xr.DataArray) -> xr.Dataset:
    """Offsets between which all limits of a mode are kept, and the limit that governs either side.

    Not a number where no offset keeps them.
    """
    modes = [str(name).split(":")[0] for name in limits["limit"].values]
    parts = []
    for mode in dict.fromkeys(modes):
        of = limits.isel(limit=[k for k, name in enumerate(modes) if name == mode])
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
    names = [str(name).split(": ", 1)[1] for name in of["limit"].values]
    return which.copy(data=np.array(names, object)[which.values]).drop_vars("offset_side")
