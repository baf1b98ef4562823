"""Beyond Mao, Zeng, Liu: limits of the platform's speed, and the riser's tension in heave."""

from __future__ import annotations

import json

import numpy as np
import xarray as xr

from chapters.mao_hangoff.towed import at_top
from riserstudy.dataset.crossing import first_crossing
from riserstudy.dataset.describe import described
from riserstudy.scene.units import to_si

PAPER = "mao_hangoff"
KNOT = 1852.0 / 3600.0  # m/s


def speed_limits(
    steady: xr.Dataset, joint_angle: str, clearance: str, keel: str, yield_stress: str, share_of_yield: float
) -> xr.Dataset:
    """Largest speed that meets all limits, over length, LMRP mass and current, and the governing limit.

    ``speed_limit`` is the platform's speed over ground; ``speed_through_water`` adds the surface speed of the
    current, against which the platform sails (both in knots).

    Parameters
    ----------
    steady : shapes, tensions and moments over the axes and ``platform_speed``.
    joint_angle : largest allowable flex joint angle, with its unit.
    clearance : allowable horizontal distance between the riser at keel depth and the joint, with its unit.
    keel : depth of the keel below the joint, with its unit.
    yield_stress, share_of_yield : yield stress, with its unit, and the share of it that limits the stress.

    Raises
    ------
    ValueError
        If one of these texts is not a quantity of its kind.
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
    reached = first_crossing(use, 1.0, along="platform_speed")
    first, fastest = reached.min("limit"), float(use["platform_speed"][-1])
    none = np.isinf(first)
    speed = first.where(~none, fastest)
    governing = reached.argmin("limit").where(~none, -1).astype(float)
    made = xr.Dataset({"use_of_limit": use, "speed_limit": speed, "governing_limit": governing})
    made["speed_through_water"] = speed + use["current_speed"] / KNOT
    return described(made, PAPER, "largest steady speed within limits")


def _at_the_keel(steady: xr.Dataset, keel: float) -> xr.DataArray:
    """Horizontal distance between the riser at keel depth and the joint (m)."""
    angles = []
    for length in steady["riser_length"].values:
        x = steady["x"].sel(riser_length=length).dropna("s")
        edge = float(x["s"][-1]) - keel
        angles.append(abs(x.interp(s=edge) - x.isel(s=-1, drop=True)).drop_vars("s"))
    return xr.concat(angles, steady["riser_length"])


def tension_limits(hang_off: xr.Dataset, hang_off_lost: xr.Dataset) -> xr.Dataset:
    """Range of the top tension (N), and least heave amplitude (m) at which tension becomes negative.

    The amplitude is NaN if tension stays positive at all amplitudes of the grid. For a riser locked to the
    platform it is found on the finer grid, ``hang_off_lost``.
    """
    high, low = hang_off["effective_tension_max"], hang_off["effective_tension_min"]
    soft = _loses_tension(hang_off.sel(mode="soft", drop=True))
    lost = xr.concat([soft, _loses_tension(hang_off_lost)], xr.Variable("mode", ["soft", "hard"]))
    made = xr.Dataset(
        {
            "tension_range": at_top(high, "s_node") - at_top(low, "s_node"),
            "smallest_tension": low.min("s_node"),
            "heave_that_loses_tension": lost.sel(mode=hang_off["mode"].values),
        }
    )
    return described(made, PAPER, "tension in heave, soft and hard hang-off")


def _loses_tension(hung: xr.Dataset) -> xr.DataArray:
    """Heave amplitude (m) at which the smallest tension is zero; NaN if it is outside the grid."""
    lowest = hung["effective_tension_min"].min("s_node")
    rest = hung["effective_tension_static"].min("s_node").isel(heave_amplitude=0, drop=True)
    from_rest = xr.concat([rest.expand_dims(heave_amplitude=[0.0]), lowest], "heave_amplitude")
    lost = first_crossing(-from_rest, 0.0, along="heave_amplitude")
    return lost.where(np.isfinite(lost))
