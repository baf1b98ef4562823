"""Liu et al. 2017: the cases of the drive-off side by side.

x and forces count in each run's own drive-off direction.
"""

from __future__ import annotations

import json

import numpy as np
import xarray as xr

from riserstudy.derived.shared import described
from riserstudy.scene.units import to_si

PAPER = "liu2017"
ALONE = "_no_riser"
WELLHEAD = 73.0  # m above the conductor's foot
OF_THE_RISER = ("ufj_angle", "lfj_angle", "stroke")


def driveoff(**runs: xr.Dataset) -> xr.Dataset:
    """All cases over time; what belongs to the riser is missing where there is none, its force zero."""
    cases = [
        measured(run).assign_coords(case=name).expand_dims("case") for name, run in runs.items()
    ]
    joined = xr.concat(cases, "case", join="outer", coords="minimal", compat="override")
    for name in ("riser_force_x", "riser_reaction_x"):
        joined[name] = joined[name].where(~joined["case"].str.endswith(ALONE), 0.0)
    return described(joined, PAPER, "drive-off of the platform, with and without riser")


def measured(run: xr.Dataset) -> xr.Dataset:
    """What figures and limits are read from, of a run of the platform with or without riser."""
    kept = ["platform_surge", "platform_speed_x", "thrust_x", "environment_force_x"]
    if "ufj_angle" not in run:
        return run[kept].squeeze(drop=True)
    found = run[[*kept, "riser_reaction_x", *OF_THE_RISER]]
    found["riser_force_x"] = -top_tension(run) * np.sin(run["ufj_angle"])
    found["conductor_stress"] = run["largest_stress"]
    found["wellhead_moment"] = run["bending_moment"].sel(s=WELLHEAD, method="nearest", drop=True)
    return found


def top_tension(run: xr.Dataset) -> float:
    """The constant tension (N)."""
    top = json.loads(run.attrs["scene"])["top"]
    return to_si(top["telescopic_joint"]["tension"], "N")
