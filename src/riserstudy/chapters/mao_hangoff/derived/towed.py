"""Mao, Zeng, Liu: what the figures show, the riser's shape relative to the platform and its moment.

Displacements count along the track, from the upper flex joint: negative is behind the platform.
"""

from __future__ import annotations

import numpy as np
import xarray as xr

from riserstudy.chapters.mao_hangoff.derived.limits import PAPER
from riserstudy.chapters.mao_hangoff.towed import displacement
from riserstudy.dataset.describe import described, scenes_of
from riserstudy.model.sea import current_table

STATED = 130.0  # s, the time of Fig 9


def base(base_runs: xr.Dataset) -> xr.Dataset:
    """The evacuation of Table 2."""
    return towed(base_runs, "base")


def current_profiles(readings: xr.Dataset) -> xr.Dataset:
    """Fig 8: speed of the current over its surface speed, over (current_profile, below_surface)."""
    below = xr.DataArray(np.linspace(0.0, 1800.0, 361), dims="below_surface", name="below_surface")
    shares = {}
    for place, scene in scenes_of(readings.isel(riser_weight=[0], flow=[0], lmrp_mass=[0])):
        if scene.current is None or scene.water is None:
            raise TypeError("a reading without a current")
        z, speed = current_table(scene.current, scene.water)
        here = np.interp((scene.water.surface or 0.0) - below.values, z, speed)
        shares[place["current_profile"]] = below.copy(data=here / here[0])
    names = xr.DataArray(list(shares), dims="current_profile", name="current_profile")
    table = xr.concat(shares.values(), names).assign_coords(below_surface=below)
    return described(table.to_dataset(name="current_share"), PAPER, "current profiles (assumed)")


def lmrp_mass(lmrp_mass_runs: xr.Dataset) -> xr.Dataset:
    """Fig 10."""
    return towed(lmrp_mass_runs, "lmrp_mass")


def current_speed(current_speed_runs: xr.Dataset) -> xr.Dataset:
    """Fig 11."""
    return towed(current_speed_runs, "current_speed")


def platform_speed(platform_speed_runs: xr.Dataset) -> xr.Dataset:
    """Fig 12."""
    return towed(platform_speed_runs, "platform_speed")


def riser_length(riser_length_runs: xr.Dataset) -> xr.Dataset:
    """Fig 14."""
    return towed(riser_length_runs, "riser_length")


def track_angle(track_angle_runs: xr.Dataset) -> xr.Dataset:
    """Fig 13."""
    return towed(track_angle_runs, "track_angle")


def towed(runs: xr.Dataset, name: str) -> xr.Dataset:
    """Shape, moment and axial motion of runs, over their axes.

    ``lmrp_displacement``, ``lmrp_displacement_cross`` and ``lmrp_rise`` over time,
    ``displacement_along`` over time and s, ``max_bending_moment`` at 130 s over s. s counts from the LMRP;
    there is nothing above a top.
    """
    along = displacement(runs)
    made = xr.Dataset(
        {
            "displacement_along": along,
            "lmrp_displacement": along.isel(s=0, drop=True),
            "lmrp_displacement_cross": _across(runs),
            "max_bending_moment": abs(runs["bending_moment"].sel(time=STATED, drop=True)),
            "lmrp_rise": rise(runs, 0.0),
            "ufj_angle": runs["ufj_angle"],
        }
    )
    made = described(
        made, PAPER, f"{name}, displacements along the track from the upper flex joint"
    )
    made["max_bending_moment"].attrs["long_name"] += f" at {STATED:g} s"
    return made


def _across(runs: xr.Dataset) -> xr.DataArray:
    """Displacement of the LMRP across the track (m); none where a run has no motion across it."""
    if "y" not in runs:
        return xr.zeros_like(runs["x"].isel(s=0, drop=True))
    y = runs["y"].fillna(0.0)
    across: xr.DataArray = y.isel(s=0, drop=True) - y.isel(s=-1, drop=True)
    return across


def rise(runs: xr.Dataset, s: float) -> xr.DataArray:
    """How far the node at ``s`` has risen from rest (m)."""
    rest = runs["z_static"].interp(s_node=s)
    risen: xr.DataArray = runs["z"].sel(s=s, method="nearest") - rest
    return risen.drop_vars(["s", "s_node"])
