"""Mao, Zeng, Liu: contents of the figures: the riser's shape relative to the platform, and its moment.

Displacements are measured along the track from the upper flex joint; negative is behind the platform.
"""

from __future__ import annotations

import numpy as np
import xarray as xr

from chapters.mao_hangoff.derived.limits import PAPER
from chapters.mao_hangoff.runs import STATED
from chapters.mao_hangoff.towed import displacement
from riserstudy.dataset.describe import described, scenes_of
from riserstudy.model.sea import current_table

MEAN_OVER = 10.0  # s before the stated time, for mean speeds


def base(base_runs: xr.Dataset) -> xr.Dataset:
    """Shape, moment and axial motion in the evacuation of Table 2."""
    return towed(base_runs, "base")


def reference_masses(hangoff_ref: xr.Dataset) -> xr.Dataset:
    """Case without unspecified inputs over ``lmrp_mass`` (t): the scene, and its variant of lighter LMRP."""
    names = {140.0: "hangoff_ref", 120.0: "hangoff_ref_120t"}
    masses = xr.DataArray(list(names), dims="lmrp_mass", name="lmrp_mass", attrs={"units": "t"})
    runs = [hangoff_ref.sel(variant=name, drop=True) for name in names.values()]
    return xr.concat(runs, masses, combine_attrs="override")


def end_loads(readings: xr.Dataset) -> xr.Dataset:
    """Drag per metre of riser (N/m) at the joint and at the LMRP at 130 s, in every interpretation.

    The riser's speed is its mean over the last ten seconds.
    """
    past, now = (readings["x"].sel(time=time, drop=True) for time in (STATED - MEAN_OVER, STATED))
    speed = (now - past) / MEAN_OVER
    axes = [str(dim) for dim in speed.dims if dim != "s"]
    made = {name: xr.zeros_like(speed.isel(s=0, drop=True)) for name in ("load_at_joint", "load_at_lmrp")}
    for place, scene in scenes_of(readings):
        if scene.current is None or scene.water is None or scene.riser[0].drag is None:
            raise TypeError("an interpretation without a current or drag")
        drag = scene.riser[0].drag
        z, flow = current_table(scene.current, scene.water)
        levels, coefficients = zip(*drag.table, strict=True)
        top = scene.top.elevation or 0.0
        at = {axis: place[axis] for axis in axes}
        for name, end, elevation in (
            ("load_at_joint", -1, top),
            ("load_at_lmrp", 0, top - scene.riser[0].total_length),
        ):
            coefficient = coefficients[-1] if elevation >= levels[-1] else coefficients[0]
            slip = float(np.interp(elevation, z, flow) - speed.sel(at).isel(s=end))
            load = 0.5 * scene.water.density * coefficient * drag.diameter * abs(slip) * slip
            made[name].loc[at] = load
    loads = described(xr.Dataset(made), PAPER, "loads at both ends of the riser at 130 s")
    for name in made:
        loads[name].attrs = {"units": "N/m", "long_name": name.replace("_", " ")}
    return loads


def current_profiles(readings: xr.Dataset) -> xr.Dataset:
    """Fig 8: ratio of the current speed to its surface speed, over (current_profile, below_surface)."""
    below = xr.DataArray(np.linspace(0.0, 1800.0, 361), dims="below_surface", name="below_surface")
    shares = {}
    for place, scene in scenes_of(readings.isel(riser_weight=[0], flow=[0], lmrp_mass=[0])):
        if scene.current is None or scene.water is None:
            raise TypeError("an interpretation without a current")
        z, speed = current_table(scene.current, scene.water)
        here = np.interp((scene.water.surface or 0.0) - below.values, z, speed)
        shares[place["current_profile"]] = below.copy(data=here / here[0])
    names = xr.DataArray(list(shares), dims="current_profile", name="current_profile")
    table = xr.concat(shares.values(), names).assign_coords(below_surface=below)
    return described(table.to_dataset(name="current_share"), PAPER, "current profiles (assumed)")


def lmrp_mass(lmrp_mass_runs: xr.Dataset) -> xr.Dataset:
    """Shape, moment and axial motion over the LMRP mass, for Fig 10."""
    return towed(lmrp_mass_runs, "lmrp_mass")


def current_speed(current_speed_runs: xr.Dataset) -> xr.Dataset:
    """Shape, moment and axial motion over the current speed, for Fig 11."""
    return towed(current_speed_runs, "current_speed")


def platform_speed(platform_speed_runs: xr.Dataset) -> xr.Dataset:
    """Shape, moment and axial motion over the platform speed, for Fig 12."""
    return towed(platform_speed_runs, "platform_speed")


def riser_length(riser_length_runs: xr.Dataset) -> xr.Dataset:
    """Shape, moment and axial motion over the riser length, for Fig 14."""
    return towed(riser_length_runs, "riser_length")


def track_angle(track_angle_runs: xr.Dataset) -> xr.Dataset:
    """Shape, moment and axial motion over the track angle, for Fig 13."""
    return towed(track_angle_runs, "track_angle")


def towed(runs: xr.Dataset, name: str) -> xr.Dataset:
    """Shape, moment and axial motion of runs, over their axes.

    ``lmrp_displacement``, ``lmrp_displacement_cross`` and ``lmrp_rise`` over time,
    ``displacement_along`` over time and s, ``bending_moment_size`` at 130 s over s. s counts from the LMRP;
    there are no values above a riser's top.
    """
    along = displacement(runs)
    made = xr.Dataset(
        {
            "displacement_along": along,
            "lmrp_displacement": along.isel(s=0, drop=True),
            "lmrp_displacement_cross": _across(runs),
            "bending_moment_size": abs(runs["bending_moment"].sel(time=STATED, drop=True)),
            "lmrp_rise": rise(runs, 0.0),
            "ufj_angle": runs["ufj_angle"],
        }
    )
    made = described(made, PAPER, f"{name}, displacements along the track from the upper flex joint")
    made["bending_moment_size"].attrs["long_name"] += f" at {STATED:g} s"
    return made


def _across(runs: xr.Dataset) -> xr.DataArray:
    """Displacement of the LMRP across the track (m); zero for runs without motion across it."""
    if "y" not in runs:
        return xr.zeros_like(runs["x"].isel(s=0, drop=True))
    y = runs["y"].fillna(0.0)
    across: xr.DataArray = y.isel(s=0, drop=True) - y.isel(s=-1, drop=True)
    return across


def rise(runs: xr.Dataset, s: float) -> xr.DataArray:
    """Rise of the node at ``s`` (m) from its static equilibrium."""
    rest = runs["z_static"].interp(s_node=s)
    risen: xr.DataArray = runs["z"].sel(s=s, method="nearest") - rest
    return risen.drop_vars(["s", "s_node"])
