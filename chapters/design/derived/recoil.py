"""Design, recoil: outcome of each disconnect, the worst over its phases, and the suitable settings."""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.dataset.describe import described, scenes_of
from riserstudy.design.recoil import limits, outcome

PAPER = "design"
#: outcome of a disconnect, by its worst phase; both together are 3
DOWN, OUT = 1, 2


def recoil_outcome(recoil: xr.Dataset) -> xr.Dataset:
    """Return lift, clearance, re-contact and stroke of every disconnect, and the range of suitable settings.

    Parameters
    ----------
    recoil : disconnects over ``phase``, ``gas_pressure`` and other axes.
    """
    made = _judged(recoil)
    names = ("setting", "comes_down", "strokes_out")
    settings, down, out = xr.broadcast(*(made[name] for name in names))
    rows = [
        limits(settings.isel(at).values, down.isel(at).values > 0, out.isel(at).values > 0)
        for at in _others(made["comes_down"])
    ]
    others = [dim for dim in made["comes_down"].dims if dim != "gas_pressure"]
    shape = [made.sizes[dim] for dim in others]
    for name, values in zip(
        ("recoil_minimum", "recoil_below", "recoil_maximum", "recoil_above"), np.array(rows).T, strict=True
    ):
        made[name] = (others, values.reshape(shape))
    return described(made, PAPER, "outcome of emergency disconnects")


def recoil_failures_outcome(recoil_failures: xr.Dataset) -> xr.Dataset:
    """Return the same for disconnects with failed units and valves, without the limits of the setting.

    Parameters
    ----------
    recoil_failures : disconnects over ``phase``, ``units``, ``valve_left_open`` and ``gas_pressure``.
    """
    return described(_judged(recoil_failures), PAPER, "emergency disconnects with failed parts")


def _others(of: xr.DataArray) -> list[dict[str, int]]:
    """Positions on all axes except the axis of the setting."""
    others = [dim for dim in of.dims if dim != "gas_pressure"]
    shape = [of.sizes[dim] for dim in others]
    return [dict(zip(map(str, others), at, strict=True)) for at in np.ndindex(*shape)]


def _judged(of: xr.Dataset) -> xr.Dataset:
    """Outcomes of each point, and of the worst phase."""
    stroke = next(s.top.tensioners.stroke for _, s in scenes_of(of) if s.top.tensioners)
    if stroke is None:
        raise TypeError("cylinders without ends")  # the scene of the study has ends
    axes = [str(dim) for dim in of["point_key"].dims]
    shape = of["point_key"].shape
    reach = of["tensioner_stroke"].transpose(*axes, "cylinder", "time")
    far = reach.isel(cylinder=0)  # all cylinders move equally
    lift = of["lift"].transpose(*axes, "time")
    lifts, reaches = (array.values.reshape(-1, array.sizes["time"]) for array in (lift, far))
    judged = outcome(of["time"].values, lifts, reaches, (stroke.shortest, stroke.longest))
    made = xr.Dataset(coords={axis: of[axis] for axis in axes})
    for name, values in (
        ("lift_max", judged.lift),
        ("clearance_min", judged.clearance),
        ("recontact", judged.recontact.astype(np.int8)),
        ("reach_min", judged.shortest),
        ("stroke_out", judged.stroked_out.astype(np.int8)),
    ):
        made[name] = (axes, values.reshape(shape))
    made["lift_rate_max"] = of["lift_rate"].max("time")
    made["smallest_tension"] = of["smallest_tension"]
    at_rest = {axis: 0 for axis in ("phase", "heave_amplitude") if axis in axes}
    made["setting"] = of["tensioner_force_static"].sum("cylinder").isel(at_rest, drop=True)
    made["comes_down"] = made["recontact"].max("phase")
    made["strokes_out"] = made["stroke_out"].max("phase")
    made["recoil_verdict"] = DOWN * made["comes_down"] + OUT * made["strokes_out"]
    return made
