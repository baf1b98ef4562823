"""Beyond Mao, Zeng, Liu: what limits a captain's speed, and a riser's tension in heave."""

from __future__ import annotations

import json

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from riserstudy.chapters.mao_hangoff.towed import at_top
from riserstudy.dataset.describe import described
from riserstudy.scene.units import to_si

FloatArray = NDArray[np.float64]
PAPER = "mao_hangoff"
KNOT = 1852.0 / 3600.0  # m/s


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
    return described(made, PAPER, "largest steady speed within limits")


def _at_the_keel(steady: xr.Dataset, keel: float) -> xr.DataArray:
    """Distance of the riser from below the joint, at the keel (m)."""
    angles = []
    for length in steady["riser_length"].values:
        x = steady["x"].sel(riser_length=length).dropna("s")
        edge = float(x["s"][-1]) - keel
        angles.append(abs(x.interp(s=edge) - x.isel(s=-1, drop=True)).drop_vars("s"))
    return xr.concat(angles, steady["riser_length"])


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
    rest = hang_off["effective_tension_static"].min("s_node").isel(heave_amplitude=0, drop=True)
    lost = xr.apply_ufunc(
        _first_below_zero,
        rest,
        lowest,
        lowest["heave_amplitude"],
        input_core_dims=[[], ["heave_amplitude"], ["heave_amplitude"]],
        vectorize=True,
    )
    made = xr.Dataset(
        {
            "tension_range": at_top(high, "s_node") - at_top(low, "s_node"),
            "smallest_tension": lowest,
            "heave_that_loses_tension": lost,
        }
    )
    return described(made, PAPER, "tension in heave, soft and hard hang-off")


def _first_below_zero(rest: float, lowest: FloatArray, amplitude: FloatArray) -> float:
    """Amplitude at which the lowest tension is zero, on straight lines from that at rest."""
    tension, heave = np.append(rest, lowest), np.append(0.0, amplitude)
    below = np.flatnonzero(tension < 0.0)
    if not len(below):
        return float("nan")
    j = int(below[0])
    share = tension[j - 1] / (tension[j - 1] - tension[j])
    return float(heave[j - 1] + share * (heave[j] - heave[j - 1]))
