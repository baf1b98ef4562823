"""Mao, Zeng, Liu: what the figures show, the riser's shape relative to the platform and its moment.

Displacements count along the track, from the upper flex joint: negative is behind the platform.
"""

from __future__ import annotations

import xarray as xr

from riserstudy.quantities.towed import displacement
from riserstudy.simulation import attributes

STATED = 130.0  # s, the time of Fig 9


def base(base_runs: xr.Dataset) -> xr.Dataset:
    """The evacuation of Table 2."""
    return towed(base_runs, "base")


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


def towed(runs: xr.Dataset, name: str) -> xr.Dataset:
    """Shape, moment and axial motion of runs, over their axes.

    ``lmrp_displacement`` and ``lmrp_rise`` over time, ``displacement_along`` over time and s,
    ``max_bending_moment`` at 130 s over s. s counts from the LMRP; there is nothing above a top.
    """
    along = displacement(runs)
    made = xr.Dataset(
        {
            "displacement_along": along,
            "lmrp_displacement": along.isel(s=0, drop=True),
            "max_bending_moment": abs(runs["bending_moment"].sel(time=STATED, drop=True)),
            "lmrp_rise": rise(runs, 0.0),
            "ufj_angle": runs["ufj_angle"],
        }
    )
    for label in made.variables:
        made[label].attrs = attributes(str(label))
    made.attrs = {
        "Conventions": "CF-1.11",
        "paper": "mao_hangoff",
        "title": f"mao_hangoff {name}: displacements along the track from the upper flex joint",
    }
    return made


def rise(runs: xr.Dataset, s: float) -> xr.DataArray:
    """How far the node at ``s`` has risen from rest (m)."""
    rest = runs["z_static"].interp(s_node=s)
    risen: xr.DataArray = runs["z"].sel(s=s, method="nearest") - rest
    return risen.drop_vars(["s", "s_node"])
