"""Liu et al. 2017: drive-offs compared, times at which limits are reached, watch circles, static offsets.

x and forces are positive in the drive-off direction of each run.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import xarray as xr

from chapters.liu2017.limits import BOTTOM, LIMITS, reached, shares, starts
from riserstudy.dataset.crossing import at_time, first_crossing, first_limit
from riserstudy.dataset.describe import described
from riserstudy.design.watch_circles import red_and_yellow, with_flags
from riserstudy.scene.units import to_si

PAPER = "liu2017"
BEGUN = (0.02, 0.03, 0.05, 0.07, 0.1)  # shares of a limit
FEW = 10  # stations: a run with no more of them does not contain the whole riser
ALONE = "_no_riser"
WELLHEAD, LOW = 73.0, 218.0  # m above the conductor's foot: wellhead; a tenth up the riser
OF_THE_PLATFORM = ("platform_surge", "platform_speed_x", "thrust_x", "environment_force_x")
FORCES_OF_THE_RISER = ("riser_force_x", "riser_reaction_x")
OF_THE_RISER = ("riser_reaction_x", "ufj_angle", "lfj_angle", "stroke")


# drive-offs


def driveoff(**runs: xr.Dataset) -> xr.Dataset:
    """All cases over time. Without riser, its variables are missing, but its forces are zero."""
    cases = [measured(run).assign_coords(case=name).expand_dims("case") for name, run in runs.items()]
    joined = xr.concat(cases, "case", join="outer", coords="minimal", compat="override")
    return described(joined, PAPER, "drive-off of the platform, with and without riser")


def base(**runs: xr.Dataset) -> xr.Dataset:
    """Drive-off with unlimited thrust, along and against the environment, as input of the claims."""
    return _both_ways(runs, "ref")


def base_limited(**runs: xr.Dataset) -> xr.Dataset:
    """Drive-off with limited thrust, along and against the environment, as input of the claims."""
    return _both_ways(runs, "sat")


def open_drive_off(open_runs: xr.Dataset, open_no_riser: xr.Dataset) -> xr.Dataset:
    """Drive-off for samples of the unspecified inputs, and the time at which each reaches each limit."""
    dataset = measured(open_runs)
    dataset["surge_alone"] = open_no_riser["platform_surge"].squeeze("below", drop=True)
    dataset["limit_time"] = reached(dataset)
    for name, values in open_runs.data_vars.items():
        if str(name).startswith("assumed_"):
            dataset[name] = values
    return described(dataset, PAPER, "drive-off, for samples of the unspecified inputs")


def open_as_printed(
    open_runs: xr.Dataset, open_no_riser: xr.Dataset, deadline: float, one_in: int
) -> xr.Dataset:
    """Samples in which the upper flex joint reaches its limit nearest to the published time.

    Parameters
    ----------
    deadline : published time (s).
    one_in : one of every ``one_in`` samples is kept, and at least one in all.
    """
    dataset = open_drive_off(open_runs, open_no_riser)
    off = abs(dataset["limit_time"].sel(heading="along", limit="upper flex joint") - deadline)
    count = max(1, off.size // one_in)
    return dataset.isel(sample=np.sort(np.argsort(off.values, kind="stable")[:count]))


def _both_ways(runs: dict[str, xr.Dataset], kind: str) -> xr.Dataset:
    parts = []
    for heading, degrees in (("along", 0), ("against", 180)):
        part = measured(runs[f"{kind}_{degrees}"])
        alone = runs[f"{kind}_{degrees}{ALONE}"]["platform_surge"].squeeze(drop=True)
        parts.append(part.assign(surge_alone=alone).assign_coords(heading=heading))
    joined = xr.concat(parts, "heading", coords="minimal", compat="override")
    return described(joined, PAPER, "drive-off along and against the environment")


def measured(run: xr.Dataset) -> xr.Dataset:
    """Variables that figures and limits are computed from, of runs of the platform with or without riser."""
    if "ufj_angle" not in run:
        alone = run[list(OF_THE_PLATFORM)].squeeze(drop=True)
        none = xr.zeros_like(alone["platform_surge"]).drop_attrs()
        return alone.assign(dict.fromkeys(FORCES_OF_THE_RISER, none))
    dataset = run[[name for name in (*OF_THE_PLATFORM, *OF_THE_RISER) if name in run]]
    aside = run.get("platform_sway", 0.0)
    dataset["platform_offset"] = np.hypot(run["platform_surge"], aside)
    dataset["riser_force_x"] = -top_tension(run) * np.sin(run["ufj_angle"])
    dataset["conductor_stress"] = run["largest_stress"]
    moment = run["bending_moment"]
    dataset["wellhead_moment"] = moment.sel(s=WELLHEAD, method="nearest", drop=True)
    if "x" in run and run.sizes["s"] > 1:
        low = run["x"].sel(s=LOW, method="nearest", drop=True)
        dataset["low_displacement"] = low - low.isel(time=0, drop=True)
    if "effective_tension" in run and run.sizes["s"] > FEW:
        dataset["riser_stress"] = riser_stress(run)
    return dataset


def riser_stress(run: xr.Dataset) -> xr.DataArray:
    """Largest stress (Pa) at the outer fibre of the riser, from a run with outputs at all its nodes.

    It is the sixth limit that the paper names, 386 MPa: tension divided by the area of the wall, plus
    moment divided by the section modulus.
    """
    riser = json.loads(run.attrs["scene"])["riser"]
    below = sum(to_si(section["length"], "m") for section in riser[:2])
    pipe = run.sel(s=slice(below, below + to_si(riser[2]["length"], "m")))
    return _stress(riser[2], pipe["effective_tension"], pipe["bending_moment"]).max("s")


def _stress(section: dict[str, Any], tension: xr.DataArray, moment: xr.DataArray) -> xr.DataArray:
    """Stress (Pa) at the outer fibre of a section of the scene's file."""
    outer, inner = (to_si(section[f"{side}_diameter"], "m") for side in ("outer", "inner"))
    area = 0.25 * math.pi * (outer**2 - inner**2)
    fibre = 32.0 * outer / (math.pi * (outer**4 - inner**4))
    return abs(tension) / area + fibre * abs(moment)


def calibration(fits: xr.Dataset, deadline: float) -> xr.Dataset:
    """Upper flex joint angle at and up to ``deadline`` (s), and time of its limit, over the fitted inputs."""
    angle = abs(fits["ufj_angle"])
    dataset = xr.Dataset(
        {
            "ufj_angle": angle.interp(time=deadline).drop_vars("time"),
            "ufj_angle_absmax": angle.sel(time=slice(0.0, deadline)).max("time"),
            "ufj_limit_time": first_crossing(angle, LIMITS["upper flex joint"].most),
        }
    )
    scene = json.loads(fits.attrs["scene"])
    vessel = scene["vessel"]
    fit = {
        "riser_weight": to_si(scene["riser"][2]["submerged_weight"], "N/m"),
        "gain": to_si(vessel["thrusters"]["gain"], "kN/m"),
        "hull_drag": to_si(vessel["hull_drag"], "kN*s^2/m^2"),
    }
    return described(dataset, PAPER, "fits to the single printed number").assign_attrs(fit)


# limits


def disconnect(headings: xr.Dataset, eds_times: list[str], preparing: str) -> xr.Dataset:
    """Time and offset at which each limit is reached, the first limit, and the resulting watch circles.

    Parameters
    ----------
    eds_times : durations of the emergency disconnect, from the red alarm on, with units.
    preparing : time from the yellow alarm to the red alarm, with its unit.
    """
    runs = measured(headings)
    runs = runs.assign_coords(environment_heading=headings["environment_heading"].astype(float))
    times = reached(runs)
    first, offset = times.min("limit", skipna=False), runs["platform_offset"]
    dataset = xr.Dataset(
        {
            "limit_time": times,
            "limit_offset": at_time(offset, times).where(np.isfinite(times)),
            "first_limit": first_limit(times),
            "disconnect_time": first,
        }
    ).assign(red_and_yellow(first, offset, eds_times, preparing))
    return with_flags(described(dataset, PAPER, "offsets of disconnect and watch circles"))


def lag(late: xr.Dataset) -> xr.Dataset:
    """Delay of the bottom behind the upper flex joint, with and without inertia and drag.

    The dimension ``begun`` is the share of its limit at which a quantity counts as having begun to respond.
    """
    dataset = measured(late)
    begins = xr.concat([starts(dataset, share) for share in BEGUN], xr.Variable("begun", list(BEGUN)))
    bottom = begins.sel(limit=list(BOTTOM)).min("limit")
    dataset["lag"] = bottom - begins.sel(limit="upper flex joint", drop=True)
    return described(dataset, PAPER, "causes of the late response of the bottom")


def losses(ref_0: xr.Dataset, drift: xr.Dataset) -> xr.Dataset:
    """Used shares of the limits over time in drive-off and drift-off, and times at which they are reached."""
    parts = []
    for name, run in (("drive-off", ref_0), ("drift-off", drift)):
        dataset = measured(run)
        part = xr.Dataset({"limit_share": shares(dataset), "platform_surge": dataset["platform_surge"]})
        part["riser_force_x"] = dataset["riser_force_x"]
        part["limit_time"] = reached(dataset)
        part["riser_stress"] = dataset["riser_stress"]
        part["riser_tension"] = top_tension(run)
        parts.append(part.assign_coords(loss=name))
    joined = xr.concat(parts, "loss", join="outer", coords="minimal", compat="override")
    return described(joined, PAPER, "drive-off and drift-off")


def envelope(offsets: xr.Dataset) -> xr.Dataset:
    """Used shares of the limits in static equilibrium; offset at which each is reached, over the current."""
    dataset = xr.Dataset({"limit_share": shares(_at_rest(offsets))})
    dataset["limit_offset"] = first_crossing(dataset["limit_share"], 1.0, along="offset")
    return described(dataset, PAPER, "static offsets at which limits are reached")


def _at_rest(rest: xr.Dataset) -> xr.Dataset:
    """Angles, stroke, stress and moment of risers in static equilibrium, from their shapes and moments.

    The stroke is relative to the riser without offset and without current.
    """
    scene = json.loads(rest.attrs["scene"])
    riser, joint = scene["riser"], scene["top"]["telescopic_joint"]
    x, z, moment = rest["x_static"], rest["z_static"], rest["bending_moment_static"]
    across, up = (part.isel(s_node=-1) - part.isel(s_node=-2) for part in (x, z))
    length = (across**2 + up**2) ** 0.5
    soft = to_si(joint["length"], "m") / to_si(joint["bending_stiffness"], "N*m^2")
    bend = soft * (moment.isel(s_node=-1) / 3.0 + moment.isel(s_node=-2) / 6.0)
    stiffness = to_si(riser[2]["flex_joint_below"]["stiffness"], "N*m/rad")
    foot = WELLHEAD + to_si(riser[1]["length"], "m")
    conductor = rest["s_node"] <= WELLHEAD + 1e-6
    stress = _stress(riser[0], rest["effective_tension_static"], moment)
    return xr.Dataset(
        {
            "ufj_angle": np.arctan2(across, up) + bend,
            "lfj_angle": moment.sel(s_node=foot, method="nearest", drop=True) / stiffness,
            "stroke": length - length.sel(offset=0.0, surface_speed=0.0, drop=True),
            "conductor_stress": stress.where(conductor).max("s_node"),
            "wellhead_moment": moment.sel(s_node=WELLHEAD, method="nearest", drop=True),
        }
    )


def top_tension(run: xr.Dataset) -> xr.DataArray:
    """Tension (N) along the telescopic joint; in runs with few stations, NaN after stroke-out.

    It is constant before stroke-out; after it, the riser's own pull is added.
    """
    if "effective_tension" in run and run.sizes["s"] > FEW:
        return run["effective_tension"].isel(s=-1, drop=True)
    joint: dict[str, Any] = json.loads(run.attrs["scene"])["top"]["telescopic_joint"]
    constant = xr.full_like(run["stroke"], to_si(joint["tension"], "N"))
    return constant.where(run["stroke"] < LIMITS["telescopic joint"].most)
