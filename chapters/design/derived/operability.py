"""Design, operability: offsets at which limits are reached, over the axes of a study."""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.dataset.describe import described, scenes_of
from riserstudy.dataset.limits import PARTS, coordinates
from riserstudy.design.envelopes import SIDES, envelopes
from riserstudy.scene.limits import UNITS
from riserstudy.scene.units import to_si

PAPER = "design"


def operability(rests: xr.Dataset, reach: str, allowances: dict[str, str]) -> xr.Dataset:
    """Return the offsets between which each limit is met, over the axes of the risers at rest.

    Parameters
    ----------
    rests : risers at rest above the well.
    reach : range of the search to either side, with its unit.
    allowances : dynamic allowance by output, with its unit.
    """
    from riserstudy.design.operability import offsets  # loads kernels

    found, over_limits = [], {}
    for _, scene in scenes_of(rests):
        over_limits = coordinates(scene.limits or [])
        found.append([each[:2] for each in offsets(scene, to_si(reach, "m"), allowed(allowances))])
    over = [str(dim) for dim in rests["point_key"].dims]
    values = np.array(found).reshape(*rests["point_key"].shape, len(over_limits["limit"]), len(SIDES))
    coords = {dim: rests[dim] for dim in over}
    limits = xr.DataArray(
        values,
        dims=(*over, "limit", "offset_side"),
        coords=coords | over_limits | {"offset_side": list(SIDES)},
    )
    made = xr.Dataset({"offset_of_limit": limits}).merge(envelopes(limits)).reset_coords(PARTS)
    made.attrs["reach"] = to_si(reach, "m")
    kept = dict(made.attrs)
    return described(made, PAPER, "offsets at which limits are reached").assign_attrs(kept)


def allowed(allowances: dict[str, str]) -> dict[str, float]:
    """Convert dynamic allowances with units to the SI units of their limits."""
    return {name: to_si(str(value), UNITS[name]) for name, value in allowances.items()}
