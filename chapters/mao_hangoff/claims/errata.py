"""Mao, Zeng, Liu: results of simulations for errors and contradictions of the text."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray as xr

from chapters.mao_hangoff.claims.heave import lmrp_motion
from chapters.mao_hangoff.claims.towed import distance_follows, grows_in_time
from chapters.mao_hangoff.hanging import largest_rise
from chapters.mao_hangoff.runs import (
    PRINTED,
    STATED,
    as_drawn,
    at_angle,
    at_nodes_of_paper,
    distance,
    largest,
    misses_of_print,
    moments,
    track_name,
)
from chapters.mao_hangoff.towed import at_top
from riserstudy.grading.found import answers
from riserstudy.grading.word_of_size import Word
from riserstudy.scene.origin import unwrap
from riserstudy.scene.units import to_si

CURRENT = 3.0  # m/s, in the tracks that errata quote


def readings_near(
    runs: xr.Dataset, heavy: float, light: float, moment: float, within: float
) -> dict[str, Any]:
    """Number of interpretations near each printed number, their ratio, and all of these; the nearest of them.

    Parameters
    ----------
    runs : runs over the axes of the interpretations and ``lmrp_mass``.
    heavy, light : printed distances with 140 and 120 t (m).
    moment : printed largest moment (kN m).
    within : share of a number that counts as near.
    """
    misses = misses_of_print(runs, heavy, light, moment)
    near: dict[str, Any] = {str(name): _near(miss, within) for name, miss in misses.items()}
    worst = misses.to_dataarray("number").max("number")
    three = misses[list(PRINTED)].to_dataarray("number").max("number").stack(reading=worst.dims)
    least = three.isel(reading=int(three.argmin("reading")))
    return near | {
        "count": worst.size,
        "printed_ratio": light / heavy,
        "all": _near(worst, within),
        "best": " / ".join(least["reading"].item()),
        "worst": float(least),
    }


def _near(miss: xr.DataArray, within: float) -> str:
    """Subject and verb on the number of combinations with an error of at most ``within``."""
    near = int((miss <= within).sum())
    count = f"{near} of {miss.size}" if near else f"None of {miss.size}"
    return f"{count} combinations of interpretations {'is' if near < 2 else 'are'}"


def parts_of_samples(
    runs: xr.Dataset, at_most: float, change: Word, ramp: float, area: float
) -> dict[str, Any]:
    """Share of samples in which C5 and C10 are true, above and below a ramp time and a drag area.

    Parameters
    ----------
    runs : runs over ``sample`` and ``lmrp_mass``.
    at_most, change : limits of C5 and C10.
    ramp : ramp time of the platform's speed (s).
    area : drag area of the LMRP (m2).
    """
    claims = {"C5": grows_in_time(runs, at_most), "C10": distance_follows(runs, "lmrp_mass", -1.0, change)}
    sides = {
        "ramp": _drawn(runs, "platform_cruise_ramp", "s") > ramp,
        "area": _drawn(runs, "bottom_body_drag_area_horizontal", "m^2") > area,
    }
    facts: dict[str, Any] = {"ramp": ramp, "area": area}
    for name, found in claims.items():
        true = answers(found) > 0
        for side, above in sides.items():
            facts[f"{name}_{side}_above"] = float(true.sel(sample=above).mean())
            facts[f"{name}_{side}_below"] = float(true.sel(sample=~above).mean())
    return facts | {f"{side}_count": int(above.sum()) for side, above in sides.items()}


def _drawn(runs: xr.Dataset, name: str, unit: str) -> xr.DataArray:
    """Values of an input that samples assume; datasets contain them as text with units."""
    texts = runs[f"assumed_{name}"]
    return texts.copy(data=[to_si(str(text), unit) for text in texts.values])


def lighter(runs: xr.Dataset, heavy: float, light: float) -> dict[str, Any]:
    """Distance x (m) for the three masses of Fig 10, and its relative increase from 140 to 120 t."""
    x = distance(runs)
    distances = {f"x{mass:g}": float(x.sel(lmrp_mass=mass)) for mass in (120.0, 130.0, 140.0)}
    return distances | {"growth": distances["x120"] / distances["x140"] - 1.0, "printed": light / heavy - 1.0}


def variants(runs: xr.Dataset) -> dict[str, Any]:
    """For every variant: x (m), M (kN m), the depth of M (m) and the moment at the joint (kN m)."""
    over_s = moments(runs)
    facts: dict[str, Any] = {}
    names = {
        "base": "base",
        "paper": "mesh and step of the paper",
        "half": "half the tension",
        "added": "C_a 2",
        "bare": "without added mass",
        "damped": "structural damping of 2 %",
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
    top, x = at_top(over_s), distance(runs)
    for short, name in names.items():
        # only nodes of this variant: with a lever arm, another variant's riser is longer
        one = over_s.sel(variant=name).dropna("s")
        one = at_nodes_of_paper(one) if short == "paper" else one
        facts[f"x_{short}"] = float(x.sel(variant=name))
        facts[f"m_{short}"] = float(one.max()) / 1e3
        facts[f"d_{short}"] = float(one["s"][-1] - one.idxmax("s"))
        facts[f"t_{short}"] = float(top.sel(variant=name)) / 1e3
    return facts


def tracks(runs: xr.Dataset) -> dict[str, Any]:
    """Distance x (m) at five angles of the track, in a current of 3 m/s."""
    x = distance(runs)
    return {f"x{angle}": float(_in_current(at_angle(x, angle))) for angle in (0, 45, 90, 135, 180)}


def _in_current(values: xr.DataArray) -> xr.DataArray:
    return values.sel(track_current=CURRENT) if "track_current" in values.dims else values


def load_power(runs: xr.Dataset) -> dict[str, Any]:
    """Exponent with which x increases with speed: tracks at 0 and 180 deg, both speeds in one profile."""
    x, sets = tracks(runs), unwrap(json.loads(runs["track"].attrs["sets"]))[0]
    slow, fast = (
        abs(to_si(sets[track_name(angle, CURRENT)]["current.profile.surface_speed"], "m/s"))
        for angle in (0, 180)
    )
    ratio = x["x180"] / x["x0"]
    power = float(np.log(ratio) / np.log(fast / slow))
    return {"slow": slow, "fast": fast, "ratio": ratio, "power": power}


def flows(runs: xr.Dataset) -> dict[str, Any]:
    """Distance x (m) in every interpretation of direction and speed, for the base riser and profile."""
    x = distance(runs).sel(lmrp_mass=140.0).isel(riser_weight=0, current_profile=0)
    words = {"against": "against, 1 m/s", "along": "along, 1 m/s", "one": "both in one profile, 2 m/s"}
    words |= {"fast_against": "against, 1.289 m/s", "fast_along": "along, 1.289 m/s"}
    return {short: float(x.sel(flow=name)) for short, name in words.items()}


def sweep(runs: xr.Dataset, axis: str) -> dict[str, Any]:
    """Distance x (m) and M (kN m) at both ends of an axis."""
    runs = as_drawn(runs)
    x, m = distance(runs), largest(runs) / 1e3
    return {
        f"{name}_{word}": float(values.isel({axis: end}))
        for name, values in (("x", x), ("m", m))
        for word, end in (("first", 0), ("last", -1))
    }


def lengths(runs: xr.Dataset) -> dict[str, Any]:
    """Distance x (m), M (kN m) and flex joint angle (deg) of the shortest and the longest riser."""
    angle = abs(np.degrees(runs["ufj_angle"].sel(time=STATED)))
    ends = {f"angle_{w}": float(angle[k]) for w, k in (("first", 0), ("last", -1))}
    return sweep(runs, "riser_length") | ends


def axial_lengths(heave: xr.Dataset) -> dict[str, Any]:
    """Amplitude and largest rise of the LMRP (m) of the shortest and the longest riser."""
    a, rise = lmrp_motion(heave)["amplitude"], largest_rise(heave)
    return {
        f"{name}_{word}": float(values.isel(riser_length=end))
        for name, values in (("a", a), ("rise", rise))
        for word, end in (("first", 0), ("last", -1))
    }


def nearest_found(runs: xr.Dataset, heavy: float, light: float, moment: float) -> dict[str, Any]:
    """Distances (m) and moment (kN m) of the nearest result of a continuous search; its largest error."""
    x, m = distance(runs), largest(runs).sel(lmrp_mass=140.0, drop=True) / 1e3
    misses = misses_of_print(runs, heavy, light, moment)[list(PRINTED)].to_dataarray("number")
    facts = {f"x_{name}": float(x.sel(lmrp_mass=mass)) for name, mass in (("heavy", 140.0), ("light", 120.0))}
    return facts | {"m_heavy": float(m), "worst": float(misses.max())}
