"""Mao, Zeng, Liu: what its numbers, claims and errata are checked against.

x is the LMRP's distance from the platform along the track, M the largest moment, both at 130 s; a is the
amplitude of axial motion at the period of the heave.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray as xr

from riserstudy.published.grading import Found
from riserstudy.quantities.towed import at_top, displacement
from riserstudy.scene.origin import unwrap
from riserstudy.scene.units import to_si

STATED = 130.0  # s, the time of Fig 9
SURFACE_ZONE = 150.0  # m below the joint, where C_D is large
TIMES = [10.0, 40.0, 70.0, 100.0, 130.0]  # s, of Fig 9c
SETTLED = 70.0  # s, by then every ramp of the heave has ended
NEARLY = 0.99  # of the largest, which counts as the largest
SMALL = 0.05  # change that counts as small
PRINTED = ("x_heavy", "x_light", "moment")  # the three numbers that the paper prints
NAMED = 5  # readings told by name, the nearest of them


# printed numbers


def lmrp_distance(runs: xr.Dataset, lmrp_mass: float) -> Found:
    """Distance x (m) with an LMRP of a mass (t)."""
    return Found(_distance(runs).sel(lmrp_mass=lmrp_mass, drop=True))


def largest_moment(runs: xr.Dataset, lmrp_mass: float) -> Found:
    """M (kN m) with an LMRP of a mass (t)."""
    return Found(_moment(runs).sel(lmrp_mass=lmrp_mass, drop=True) / 1e3)


def all_numbers(
    runs: xr.Dataset, heavy: float, light: float, moment: float, within: float
) -> Found:
    """Whether one reading meets the three numbers within a share; value: its worst miss."""
    misses = _misses(runs, heavy, light, moment)
    worst = xr.concat([misses[name] for name in PRINTED], "number").max("number")
    return Found(worst, worst <= within)


def _misses(runs: xr.Dataset, heavy: float, light: float, moment: float) -> xr.Dataset:
    """Relative miss of every printed number, and of the ratio that two of them have."""
    x, m = _distance(runs), _moment(runs).sel(lmrp_mass=140.0, drop=True) / 1e3
    x_heavy, x_light = (x.sel(lmrp_mass=mass, drop=True) for mass in (140.0, 120.0))
    found = {
        "x_heavy": x_heavy / heavy,
        "x_light": x_light / light,
        "moment": m / moment,
        "ratio": x_light / x_heavy / (light / heavy),
    }
    return abs(xr.Dataset(found) - 1.0)


# Fig 9: the base case


def grows_with_depth(runs: xr.Dataset) -> Found:
    """Distance grows from node to node at 130 s; value: x over the largest distance."""
    away = abs(_heavy(displacement(runs))).sel(time=STATED, drop=True)
    value = away.isel(s=0, drop=True) / away.max("s")
    return Found(value, (away.diff("s") <= 1e-9).all("s"))


def upright_at_the_lmrp(runs: xr.Dataset, at_most: float) -> Found:
    """Slope over the lowest 50 m is much smaller than the mean one; value: their ratio."""
    away = abs(_heavy(displacement(runs))).sel(time=STATED, drop=True)
    lowest = (away.isel(s=0, drop=True) - away.interp(s=50.0).drop_vars("s")) / 50.0
    mean = away.isel(s=0, drop=True) / (float(away["s"][-1]) - float(away["s"][0]))
    return Found(lowest / mean, lowest <= at_most * mean)


def moment_at_the_top(runs: xr.Dataset) -> Found:
    """M lies in the surface zone; value: its depth below the joint (m)."""
    moment = _heavy(_moments(runs))
    depth = float(moment["s"][-1]) - moment.idxmax("s")
    return Found(depth, depth <= SURFACE_ZONE)


def small_below(runs: xr.Dataset, at_most: float) -> Found:
    """Moments below the surface zone are small; value: the largest there over M."""
    moment = _heavy(_moments(runs))
    below = moment.where(moment["s"] < float(moment["s"][-1]) - SURFACE_ZONE).max("s")
    share = below / moment.max("s")
    return Found(share, share <= at_most)


def grows_in_time(runs: xr.Dataset, at_most: float) -> Found:
    """Distance x grows from time to time of Fig 9c and is small at first; value: first over last."""
    x = abs(_heavy(displacement(runs))).sel(time=TIMES).isel(s=0, drop=True)
    first = x.isel(time=0, drop=True) / x.isel(time=-1, drop=True)
    return Found(first, (x.diff("time") > 0).all("time") & (first <= at_most))


def lower_half_moves_more(runs: xr.Dataset) -> Found:
    """The LMRP is farthest at all times, the lower half farther than the upper; value: at 130 s."""
    away = abs(_heavy(displacement(runs))).sel(time=TIMES)
    middle = 0.5 * (float(away["s"][0]) + float(away["s"][-1]))
    lower, upper = away.where(away["s"] <= middle), away.where(away["s"] >= middle)
    farthest = away.isel(s=0, drop=True) >= NEARLY * away.max("s")
    ratio = lower.mean("s") / upper.mean("s")
    true = (farthest & (ratio > 1.0)).all("time")
    return Found(ratio.isel(time=-1, drop=True), true)


# Fig 9d: along the riser


def one_frequency(heave: xr.Dataset, depths: list[float]) -> Found:
    """The heave's period explains 90 % of the motion at all depths; value: the smallest share."""
    share = _harmonic(_heavy(_z_at(heave, depths)), heave)["share"].min("depth")
    return Found(share, share >= 0.9)


def amplitude_grows_with_depth(heave: xr.Dataset, depths: list[float]) -> Found:
    """Amplitude a grows from depth to depth; value: deepest over first."""
    a = _harmonic(_heavy(_z_at(heave, depths)), heave)["amplitude"]
    ratio = a.isel(depth=-1, drop=True) / a.isel(depth=0, drop=True)
    return Found(ratio, (a.diff("depth") > 0).all("depth"))


def level_rises(heave: xr.Dataset, depth: float) -> Found:
    """The mean level at a depth rises while the riser trails off; value: m a minute."""
    rate = 60.0 * _harmonic(_heavy(_z_at(heave, [depth])), heave)["drift"].isel(depth=0, drop=True)
    return Found(rate, rate > 0.0)


# Figs 10 to 14: what changes with what


def distance_and_moment_follow(runs: xr.Dataset, axis: str, sign: float) -> Found:
    """Both x and M rise (sign 1) or fall (-1) along an axis; value: last x over first."""
    x, m = _distance(runs), _moment(runs)
    return Found(_last_over_first(x, axis), _follows(x, axis, sign) & _follows(m, axis, sign))


def distance_follows(runs: xr.Dataset, axis: str, sign: float) -> Found:
    """Distance x rises or falls along an axis; value: last over first."""
    x = _distance(runs)
    return Found(_last_over_first(x, axis), _follows(x, axis, sign))


def moment_follows(runs: xr.Dataset, axis: str, sign: float) -> Found:
    """M rises or falls along an axis; value: last over first."""
    m = _moment(runs)
    return Found(_last_over_first(m, axis), _follows(m, axis, sign))


def top_moment_follows(runs: xr.Dataset, axis: str, sign: float) -> Found:
    """M rises or falls along an axis, and is near the top at its end; value: last over first."""
    moments = _moments(runs)
    m = moments.max("s")
    depth = float(moments["s"][-1]) - moments.isel({axis: 0}, drop=True).idxmax("s")
    return Found(_last_over_first(m, axis), _follows(m, axis, sign) & (depth <= SURFACE_ZONE))


def joint_angle_follows(runs: xr.Dataset, axis: str, sign: float) -> Found:
    """The angle of the flex joint at 130 s rises or falls along an axis; value: last over first."""
    angle = abs(runs["ufj_angle"].sel(time=STATED, drop=True))
    return Found(_last_over_first(angle, axis), _follows(angle, axis, sign))


def change_near_the_lmrp(runs: xr.Dataset, at_least: float) -> Found:
    """Most of what a lighter LMRP changes arises in the lowest quarter; value: the share."""
    away = abs(displacement(runs)).sel(time=STATED, drop=True)
    change = away.sel(lmrp_mass=120.0, drop=True) - away.sel(lmrp_mass=140.0, drop=True)
    quarter = 0.25 * float(change["s"][-1])
    low = change.isel(s=0, drop=True)
    share = (low - change.interp(s=quarter).drop_vars("s")) / low
    return Found(share, share >= at_least)


def amplitude_follows(heave: xr.Dataset, axis: str, sign: float) -> Found:
    """Amplitude a of the LMRP rises or falls along an axis, at one frequency; value: last over first."""
    fit = _lmrp_motion(heave)
    steady = (fit["share"] >= 0.9).all(axis)
    a = fit["amplitude"]
    return Found(_last_over_first(a, axis), _follows(a, axis, sign) & steady)


def amplitude_hardly_changes(heave: xr.Dataset, axis: str) -> Found:
    """Amplitude a of the LMRP changes little along an axis; value: last over first."""
    ratio = _last_over_first(_lmrp_motion(heave)["amplitude"], axis)
    return Found(ratio, abs(ratio - 1.0) <= SMALL)


def all_follow(runs: xr.Dataset, heave: xr.Dataset, axis: str, sign: float) -> Found:
    """x, M and a all rise or fall along an axis; value: last x over first."""
    x, m, a = _distance(runs), _moment(runs), _lmrp_motion(heave)["amplitude"]
    true = _follows(x, axis, sign) & _follows(m, axis, sign) & _follows(a, axis, sign)
    return Found(_last_over_first(x, axis), true)


def other_way_at_90_degrees(runs: xr.Dataset, axis: str) -> Found:
    """At 90 deg the LMRP is on another side than at 0 and 45 deg; value: place at 90 over that at 0 deg."""
    place = displacement(runs).sel(time=STATED, drop=True).isel(s=0, drop=True)
    at0, at45, at90 = (_at_angle(place, axis, angle) for angle in (0, 45, 90))
    return Found(at90 / at0, (at0 * at45 > 0) & (at0 * at90 < 0))


def falls_with_angle(runs: xr.Dataset, axis: str, considerably: float) -> Found:
    """Distance x falls from 0 over 45 to 90 deg, 0 deg considerably largest; value: x at 90 over 0 deg."""
    x = _distance(runs)
    at0, at45, at90 = (_at_angle(x, axis, angle) for angle in (0, 45, 90))
    return Found(at90 / at0, (at0 >= considerably * at45) & (at45 > at90))


def grows_beyond_90_degrees(runs: xr.Dataset, axis: str) -> Found:
    """Distance x grows from 90 over 135 to 180 deg; value: x at 180 over 90 deg."""
    x = _distance(runs)
    at90, at135, at180 = (_at_angle(x, axis, angle) for angle in (90, 135, 180))
    return Found(at180 / at90, (at135 > at90) & (at180 > at135))


def _at_angle(values: xr.DataArray, axis: str, angle: float) -> xr.DataArray:
    label = f"{angle:g} deg" if axis == "track" else angle
    return values.sel({axis: label}, drop=True)


def _last_over_first(values: xr.DataArray, axis: str) -> xr.DataArray:
    return values.isel({axis: -1}, drop=True) / values.isel({axis: 0}, drop=True)


def _follows(values: xr.DataArray, axis: str, sign: float) -> xr.DataArray:
    return (sign * values.diff(axis) > 0).all(axis)


# quantities


def _heavy(values: xr.DataArray) -> xr.DataArray:
    """The printed LMRP mass, where it is varied."""
    return values.sel(lmrp_mass=140.0, drop=True) if "lmrp_mass" in values.dims else values


def _distance(runs: xr.Dataset) -> xr.DataArray:
    return abs(displacement(runs).sel(time=STATED, drop=True).isel(s=0, drop=True))


def _moments(runs: xr.Dataset) -> xr.DataArray:
    return abs(runs["bending_moment"].sel(time=STATED, drop=True))


def _moment(runs: xr.Dataset) -> xr.DataArray:
    return _moments(runs).max("s")


def _z_at(heave: xr.Dataset, depths: list[float]) -> xr.DataArray:
    """Elevation at depths below the joint (m), over ``depth``."""
    z = heave["z"]
    s = xr.DataArray(float(z["s"][-1]) - np.array(depths), dims="depth", coords={"depth": depths})
    return z.sel(s=s, method="nearest").drop_vars("s")


def _lmrp_motion(heave: xr.Dataset) -> xr.Dataset:
    return _harmonic(heave["z"].isel(s=0, drop=True), heave)


def _harmonic(z: xr.DataArray, heave: xr.Dataset) -> xr.Dataset:
    """Amplitude (m) at the heave's period, drift (m/s), and the share of the motion at that period.

    Least squares with a quadratic drift: the slow change of level is no part of the amplitude.
    """
    z = z.sel(time=slice(SETTLED, None))
    t = z["time"] - float(z["time"][0])
    period = _period(heave)

    def fit(z: Any, period: Any) -> tuple[float, float, float]:
        w = 2.0 * np.pi / period
        slow = np.stack([np.ones_like(t), t, t.values**2], axis=1)
        terms = np.concatenate(
            [slow, np.cos(w * t.values)[:, None], np.sin(w * t.values)[:, None]], 1
        )
        found = np.linalg.lstsq(terms, z, rcond=None)[0]
        wave = z - slow @ found[:3]
        left = z - terms @ found
        share = 1.0 - float(left @ left) / float(wave @ wave)
        drift = float((slow[-1] - slow[0]) @ found[:3]) / float(t[-1])
        return float(np.hypot(*found[3:])), drift, share

    amplitude, drift, share = xr.apply_ufunc(
        fit,
        z,
        period,
        input_core_dims=[["time"], []],
        output_core_dims=[[], [], []],
        vectorize=True,
    )
    return xr.Dataset({"amplitude": amplitude, "drift": drift, "share": share})


def _period(heave: xr.Dataset) -> xr.DataArray:
    """Period of the platform's heave (s): sampled, or that of the scene."""
    if "assumed_platform_heave_period" in heave:
        texts = heave["assumed_platform_heave_period"]
        return texts.copy(data=[float(str(text).split()[0]) for text in texts.values])
    scene = json.loads(heave.attrs["scene"])
    return xr.DataArray(float(scene["platform"]["heave"]["period"].split()[0]))


# errata


def readings_near(
    runs: xr.Dataset, heavy: float, light: float, moment: float, within: float
) -> dict[str, Any]:
    """Which named readings come within a share of each number and of the ratio, and which of all.

    Parameters
    ----------
    runs : over the axes of readings and ``lmrp_mass``.
    heavy, light : printed distances with 140 and 120 t (m).
    moment : printed largest moment (kN m).
    within : share of a number that counts as near.
    """
    misses = _misses(runs, heavy, light, moment)
    told: dict[str, Any] = {str(name): _near(miss, within) for name, miss in misses.items()}
    worst = misses.to_dataarray("number").max("number")
    three = misses[list(PRINTED)].to_dataarray("number").max("number").stack(reading=worst.dims)
    least = three.isel(reading=int(three.argmin("reading")))
    return told | {
        "count": worst.size,
        "printed_ratio": light / heavy,
        "all": _near(worst, within),
        "best": _of_reading(least["reading"].item()),
        "worst": float(least),
    }


def _near(miss: xr.DataArray, within: float) -> str:
    """How many cells miss by no more, and the nearest by name."""
    cells = miss.stack(reading=miss.dims)
    near = cells[cells.values <= within]
    near = near[near.values.argsort()]
    if not near.size:
        return "none"
    names = "; ".join(_of_reading(key) for key in near["reading"].values[:NAMED])
    return f"{near.size}{', nearest' if near.size > NAMED else ''} ({names})"


def _of_reading(labels: tuple[str, ...]) -> str:
    return " / ".join(labels)


def lighter(runs: xr.Dataset, heavy: float, light: float) -> dict[str, Any]:
    """Distance x (m) for the three masses of Fig 10, and how much it grows from 140 to 120 t."""
    x = _distance(runs)
    found = {f"x{mass:g}": float(x.sel(lmrp_mass=mass)) for mass in (120.0, 130.0, 140.0)}
    return found | {"growth": found["x120"] / found["x140"] - 1.0, "printed": light / heavy - 1.0}


def variants(runs: xr.Dataset) -> dict[str, Any]:
    """Of every variant: x (m), M (kN m), its depth (m) and the moment at the joint (kN m)."""
    moments = _moments(runs)
    found: dict[str, Any] = {}
    names = {
        "base": "base",
        "paper": "mesh and step of the paper",
        "half": "half the tension",
        "added": "C_a 2",
        "moving": "riser moves with the platform, water starts",
        "sudden": "without ramps",
        "fast": "platform at 1.289 m/s",
        "unit": "joint of 8800 N m/rad",
        "clamped": "joint clamped",
        "free": "joint free",
        "above": "joint 20 m above the sea",
        "deep": "joint 30 m below the sea",
        "weightless": "LMRP without weight",
        "dragged": "LMRP with drag and added mass",
        "lever": "LMRP with lever arm and rotary inertia",
    }
    top = at_top(moments)
    for short, name in names.items():
        one = moments.sel(variant=name)
        found[f"x_{short}"] = float(_distance(runs).sel(variant=name))
        found[f"m_{short}"] = float(one.max()) / 1e3
        found[f"d_{short}"] = float(moments["s"][-1] - one.idxmax("s"))
        found[f"t_{short}"] = float(top.sel(variant=name)) / 1e3
    return found


def tracks(runs: xr.Dataset) -> dict[str, Any]:
    """Distance x (m) at five angles of the track."""
    x = _distance(runs)
    return {f"x{angle}": float(_at_angle(x, "track", angle)) for angle in (0, 45, 90, 135, 180)}


def load_power(runs: xr.Dataset) -> dict[str, Any]:
    """Power of the speed with which x grows, from tracks at 0 and 180 deg with both speeds in one profile."""
    x, sets = tracks(runs), unwrap(json.loads(runs["track"].attrs["sets"]))[0]
    slow, fast = (
        abs(to_si(sets[f"{angle} deg"]["current.profile.surface_speed"], "m/s"))
        for angle in (0, 180)
    )
    ratio = x["x180"] / x["x0"]
    power = float(np.log(ratio) / np.log(fast / slow))
    return {"slow": slow, "fast": fast, "ratio": ratio, "power": power}


def flows(runs: xr.Dataset) -> dict[str, Any]:
    """Distance x (m) in every reading of direction and speed, base riser and profile."""
    x = _distance(runs).sel(lmrp_mass=140.0).isel(riser_weight=0, current_profile=0)
    words = {
        "against": "against, 1 m/s",
        "along": "along, 1 m/s",
        "one": "both in one profile, 2 m/s",
    }
    words |= {"fast_against": "against, 1.289 m/s", "fast_along": "along, 1.289 m/s"}
    return {short: float(x.sel(flow=name)) for short, name in words.items()}


def sweep(runs: xr.Dataset, axis: str) -> dict[str, Any]:
    """Distance x (m) and M (kN m) at both ends of an axis."""
    x, m = _distance(runs), _moment(runs) / 1e3
    return {
        f"{name}_{word}": float(values.isel({axis: end}))
        for name, values in (("x", x), ("m", m))
        for word, end in (("first", 0), ("last", -1))
    }


def lengths(runs: xr.Dataset) -> dict[str, Any]:
    """Distance x (m), M (kN m) and angle of the joint (deg) of the shortest and the longest riser."""
    angle = abs(np.degrees(runs["ufj_angle"].sel(time=STATED)))
    ends = {f"angle_{w}": float(angle[k]) for w, k in (("first", 0), ("last", -1))}
    return sweep(runs, "riser_length") | ends
