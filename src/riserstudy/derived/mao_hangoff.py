"""Mao, Zeng, Liu: what the figures show, the riser's shape relative to the platform and its moment.

Displacements count along the track, from the upper flex joint: negative is behind the platform.
"""

from __future__ import annotations

import json

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from riserstudy.derived.shared import described, scenes_of
from riserstudy.names import attributes
from riserstudy.quantities.towed import at_top, displacement
from riserstudy.scene.units import to_si
from riserstudy.sea import current_table

FloatArray = NDArray[np.float64]
STATED = 130.0  # s, the time of Fig 9
KNOT = 1852.0 / 3600.0  # m/s


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
    return described(
        table.to_dataset(name="current_share"), "mao_hangoff", "current profiles (assumed)"
    )


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
    return _described(made, name, "displacements along the track from the upper flex joint")


def _across(runs: xr.Dataset) -> xr.DataArray:
    """Displacement of the LMRP across the track (m); none where a run has no motion across it."""
    if "y" not in runs:
        return xr.zeros_like(runs["x"].isel(s=0, drop=True))
    y = runs["y"].fillna(0.0)
    across: xr.DataArray = y.isel(s=0, drop=True) - y.isel(s=-1, drop=True)
    return across


def _described(made: xr.Dataset, name: str, title: str) -> xr.Dataset:
    for label in made.variables:
        made[label].attrs = attributes(str(label))
    made.attrs = {
        "Conventions": "CF-1.11",
        "paper": "mao_hangoff",
        "title": f"mao_hangoff {name}: {title}",
    }
    return made


def rise(runs: xr.Dataset, s: float) -> xr.DataArray:
    """How far the node at ``s`` has risen from rest (m)."""
    rest = runs["z_static"].interp(s_node=s)
    risen: xr.DataArray = runs["z"].sel(s=s, method="nearest") - rest
    return risen.drop_vars(["s", "s_node"])


# beyond the paper


def speed_limits(
    steady: xr.Dataset,
    joint_angle: str,
    clearance: str,
    keel: str,
    yield_stress: str,
    share_of_yield: float,
) -> xr.Dataset:
    """Largest speed that keeps all limits, over length, LMRP mass and current, and what governs it.

    ``speed_limit`` is the platform's, over ground; ``speed_through_water`` adds the current that it drives
    against, at the surface (both in knots).

    Parameters
    ----------
    steady : shapes, tensions and moments over the axes and ``platform_speed``.
    joint_angle : largest angle of the flex joint, with its unit.
    clearance : how far from below the joint the riser may be at the keel, with its unit.
    keel : depth of the keel below the joint, with its unit.
    yield_stress, share_of_yield : stress is kept below this share of it.

    Raises
    ------
    ValueError
        When one of them is no quantity of its kind.
    """
    scene = json.loads(steady.attrs["scene"])
    pipe = scene["riser"][0]
    outer, inner = (to_si(pipe[name], "m") for name in ("outer_diameter", "inner_diameter"))
    area = 0.25 * np.pi * (outer**2 - inner**2)
    modulus = np.pi / 32.0 * (outer**4 - inner**4) / outer
    moment = abs(steady["bending_moment"])
    stress = (abs(steady["effective_tension"]) / area + moment / modulus).max("s")
    angle = at_top(moment) / to_si(scene["top"]["rotation"]["stiffness"], "N*m/rad")
    used = {
        "joint angle": angle / to_si(joint_angle, "rad"),
        "clearance": _at_the_keel(steady, to_si(keel, "m")) / to_si(clearance, "m"),
        "stress": stress / (share_of_yield * to_si(yield_stress, "N/m^2")),
    }
    names = xr.DataArray(list(used), dims="limit", name="limit")
    use = xr.concat(list(used.values()), names, coords="minimal", compat="override")
    speed, governing = xr.apply_ufunc(
        _first_reached,
        use,
        use["platform_speed"],
        input_core_dims=[["limit", "platform_speed"], ["platform_speed"]],
        output_core_dims=[[], []],
        vectorize=True,
    )
    made = xr.Dataset({"use_of_limit": use, "speed_limit": speed, "governing_limit": governing})
    made["speed_through_water"] = speed + use["current_speed"] / KNOT
    return _described(made, "speed_limits", "largest steady speed within limits")


def _at_the_keel(steady: xr.Dataset, keel: float) -> xr.DataArray:
    """Distance of the riser from below the joint, at the keel (m)."""
    found = []
    for length in steady["riser_length"].values:
        x = steady["x"].sel(riser_length=length).dropna("s")
        edge = float(x["s"][-1]) - keel
        found.append(abs(x.interp(s=edge) - x.isel(s=-1, drop=True)).drop_vars("s"))
    return xr.concat(found, steady["riser_length"])


def _first_reached(use: FloatArray, speed: FloatArray) -> tuple[float, float]:
    """Speed at which a limit is first used up, and which one; the highest speed and -1 for none."""
    first, which = float(speed[-1]), -1
    for k, row in enumerate(use):
        over = np.flatnonzero(row > 1.0)
        if not len(over):
            continue
        j = int(over[0])
        reached = float(speed[0])
        if j:
            share = (1.0 - row[j - 1]) / (row[j] - row[j - 1])
            reached = float(speed[j - 1] + share * (speed[j] - speed[j - 1]))
        if reached < first or which < 0:
            first, which = min(first, reached), k
    return first, float(which)


def tension_limits(hang_off: xr.Dataset) -> xr.Dataset:
    """Range of tension at the top, and the heave amplitude at which tension is first lost (m).

    Not a number where it is not lost in the amplitudes of the grid.
    """
    high, low = hang_off["effective_tension_max"], hang_off["effective_tension_min"]
    lowest = low.min("s_node")
    lost = xr.apply_ufunc(
        _first_below_zero,
        lowest,
        lowest["heave_amplitude"],
        input_core_dims=[["heave_amplitude"], ["heave_amplitude"]],
        vectorize=True,
    )
    made = xr.Dataset(
        {
            "tension_range": at_top(high, "s_node") - at_top(low, "s_node"),
            "tension_lowest": lowest,
            "heave_that_loses_tension": lost,
        }
    )
    return _described(made, "tension_limits", "tension in heave, soft and hard hang-off")


def _first_below_zero(tension: FloatArray, amplitude: FloatArray) -> float:
    below = np.flatnonzero(tension < 0.0)
    if not len(below):
        return float("nan")
    j = int(below[0])
    if j == 0:
        return float(amplitude[0])
    share = tension[j - 1] / (tension[j - 1] - tension[j])
    return float(amplitude[j - 1] + share * (amplitude[j] - amplitude[j - 1]))
