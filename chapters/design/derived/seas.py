"""Design, seas: additions of irregular seas to a riser at rest, and the remaining offsets."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

import numpy as np
import xarray as xr

from riserstudy.dataset.describe import described, scenes_of
from riserstudy.dataset.limits import coordinates
from riserstudy.dataset.statistics import gumbel
from riserstudy.design.envelopes import SIDES, envelopes
from riserstudy.scene.limits import Limit
from riserstudy.scene.units import to_si

PAPER = "design"
MODE = "drilling"
CURRENT = "surface_speed"  # axis of both studies (m/s)
NEAR = 1e-6  # m
ANGLES = ("lfj_angle", "ufj_angle")
MEAN = "mean_"  # start of the name of an allowance for limits on the mean of an output
Places = Mapping[str, tuple[float, float]]  # ends of parts of the riser (m), by name


def allowances(seas: xr.Dataset) -> xr.Dataset:
    """Dynamic allowance by output over the wave height: the value that nine seas in ten do not exceed.

    The largest motion of each seed from the value at rest is taken to follow a Gumbel distribution. The
    allowance of a mean is its change by the sea, on average over the seeds.
    """
    made = xr.Dataset({f"{name}_allowance": each for name, each in _of_seeds(seas).items()})
    return described(made, PAPER, "dynamic allowances from irregular seas")


def operability_in_seas(rests: xr.Dataset, seas: xr.Dataset, reach: str) -> xr.Dataset:
    """Offsets between which all limits of drilling are met, with the allowances of each sea.

    In a current between two simulated ones, the larger of their allowances is used. The allowances are those
    of a platform above the well, at all offsets.

    Parameters
    ----------
    rests : risers at rest above the well.
    seas : runs in irregular seas over ``significant_height``, ``surface_speed`` and ``seed``.
    reach : range of the search to either side, with its unit.
    """
    from riserstudy.design.operability import AtRest, offsets_of  # loads kernels

    _, scene = next(scenes_of(seas))
    places = {s.name: span for s, span in zip(scene.riser, pairwise(scene.borders), strict=True)}
    added = _of_seeds(seas, places)
    heights = seas["significant_height"]
    far = to_si(reach, "m")
    found, over_limits = [], {}
    for place, scene in scenes_of(rests):
        limits = [limit for limit in scene.limits or [] if limit.mode == MODE]
        over_limits = coordinates(limits)
        at = AtRest(scene, far)  # common to all seas
        for height in heights.values:
            own = {
                name: _by_place(_in_current(each.sel(significant_height=height), place.get(CURRENT)))
                for name, each in added.items()
            }
            found.append([offsets_of(at, limit, far, own[_name(limit)])[:2] for limit in limits])
    over = [str(dim) for dim in rests["point_key"].dims]
    shape = (*rests["point_key"].shape, len(heights), len(over_limits["limit"]), len(SIDES))
    coords = {dim: rests[dim] for dim in over} | {"significant_height": heights}
    limits_of = xr.DataArray(
        np.array(found).reshape(shape),
        dims=(*over, "significant_height", "limit", "offset_side"),
        coords=coords | over_limits | {"offset_side": list(SIDES)},
    )
    made = xr.Dataset({"offset_of_limit": limits_of}).merge(envelopes(limits_of))
    made = described(made, PAPER, "offsets at which limits are reached, for several seas")
    return made.assign_attrs(reach=to_si(reach, "m"))


def _in_current(each: xr.DataArray, speed: float | None) -> xr.DataArray:
    """The larger allowance of the simulated currents next to a speed (m/s) of the current."""
    if CURRENT not in each.dims or speed is None:
        return each
    speeds = each[CURRENT].values
    below, above = speeds[speeds <= speed], speeds[speeds >= speed]
    neighbours = [below.max(initial=speeds.min()), above.min(initial=speeds.max())]
    return each.sel({CURRENT: neighbours}).max(CURRENT)


def _by_place(each: xr.DataArray) -> float | dict[str, float]:
    """The allowance of an output: one value, or one for each place."""
    if not each.dims:
        return float(each)
    return dict(zip(each["place"].values.tolist(), each.values.tolist(), strict=True))


def _name(limit: Limit) -> str:
    """Name of the allowance of a limit."""
    return MEAN + limit.output if limit.side == "mean" else limit.output


def _of_seeds(seas: xr.Dataset, places: Places | None = None) -> dict[str, xr.DataArray]:
    """Allowances from the increases of the seeds, by name."""
    return {
        name: each.mean("seed") if name.startswith(MEAN) else _fractile(each)
        for name, each in _added(seas, places).items()
    }


def _added(seas: xr.Dataset, places: Places | None = None) -> dict[str, xr.DataArray]:
    """Increase of each run's outputs over their values at rest, in the unit of the output, by name.

    For angles it is the largest motion to either side, because the angle at rest has both signs over the
    range of offsets. Each of the ``places`` has its own increases of stress and tension, the largest of its
    nodes, since other parts govern at other offsets; without places, they are those of the whole riser.
    """
    motion = {name: seas[name] - seas[f"{name}_static"] for name in (*ANGLES, "joint_stroke")}
    added = {name: abs(motion[name]).max("time") for name in ANGLES}
    duration = float(seas["time"][-1] - seas["time"][0])
    added |= {MEAN + name: abs(motion[name].integrate("time") / duration) for name in ANGLES}
    added["joint_stroke"] = motion["joint_stroke"].max("time")
    stress, tension = "von_mises_stress", "effective_tension"
    parts = [seas.sel(s_node=slice(low - NEAR, up + NEAR)) for low, up in (places or {}).values()] or [seas]
    increases = {
        stress: [(of[f"{stress}_max"] - of[f"{stress}_static"]).max("s_node") for of in parts],
        tension: [(of[f"{tension}_static"] - of[f"{tension}_min"]).max("s_node") for of in parts],
    }
    for name, each in increases.items():
        added[name] = xr.concat(each, "place").assign_coords(place=list(places)) if places else each[0]
    return added


def _fractile(each: xr.DataArray) -> xr.DataArray:
    """The fractile over the seeds."""
    values: xr.DataArray = xr.apply_ufunc(
        lambda largest: gumbel(largest).fractile, each, input_core_dims=[["seed"]], vectorize=True
    )
    return values
