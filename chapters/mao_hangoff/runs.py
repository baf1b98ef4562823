"""Results of runs at 130 s for numbers, claims and errata of Mao, Zeng, Liu."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from chapters.mao_hangoff.towed import displacement

STATED = 130.0  # s, the time of Fig 9
ELEMENTS = 50  # number of equal elements in the paper
CURRENTS = (2.0, 2.5, 3.0)  # m/s, current speeds of the tracks in one profile
PRINTED = ("x_heavy", "x_light", "moment")  # the three numbers that the paper prints


def distance(runs: xr.Dataset) -> xr.DataArray:
    """Distance x of the LMRP from the platform along the track (m)."""
    return abs(displacement(runs).sel(time=STATED, drop=True).isel(s=0, drop=True))


def moments(runs: xr.Dataset) -> xr.DataArray:
    """Magnitude of the bending moment over s (N m)."""
    return abs(runs["bending_moment"].sel(time=STATED, drop=True))


def moments_over_time(runs: xr.Dataset) -> xr.DataArray:
    """Magnitude of the bending moment over time and s (N m)."""
    return abs(runs["bending_moment"])


def largest(runs: xr.Dataset) -> xr.DataArray:
    """Largest moment M (N m)."""
    return moments(runs).max("s")


def as_drawn(values: Any) -> Any:
    """Runs or values in the first current profile of Figs 11 and 12; unchanged if it is not varied."""
    return values.isel(current_profile=0, drop=True) if "current_profile" in values.dims else values


def at_nodes_of_paper(values: xr.DataArray) -> xr.DataArray:
    """Values over s at the ends of the paper's equal elements.

    A study interpolates its runs to the nodes of the finest run. Interpolated values between two nodes of 50
    elements exceed the values at both nodes.
    """
    s = values["s"]
    return values.interp(s=np.linspace(float(s[0]), float(s[-1]), ELEMENTS + 1))


def mean_over(values: xr.DataArray, low: float, high: float) -> xr.DataArray:
    """Mean over a range of s (m), by length, because nodes are closer together near the ends of a riser."""
    s = values["s"].values
    places = [low, *s[(s > low) & (s < high)], high]
    mean: xr.DataArray = values.interp(s=places).integrate("s") / (high - low)
    return mean


def halves(values: xr.DataArray) -> tuple[xr.DataArray, xr.DataArray]:
    """Means over the lower and the upper half of a riser."""
    low, high = float(values["s"][0]), float(values["s"][-1])
    middle = 0.5 * (low + high)
    return mean_over(values, low, middle), mean_over(values, middle, high)


def with_printed_lmrp(values: xr.DataArray) -> xr.DataArray:
    """Values with the printed LMRP mass; unchanged if the mass is not varied."""
    return values.sel(lmrp_mass=140.0, drop=True) if "lmrp_mass" in values.dims else values


def last_over_first(values: xr.DataArray, axis: str) -> xr.DataArray:
    """Ratio of the last value of an axis to the first."""
    return values.isel({axis: -1}, drop=True) / values.isel({axis: 0}, drop=True)


def track_name(angle: float, current: float | None = None) -> str:
    """Name of a track in one profile, by its angle (deg) and the current speed (m/s) if it has an effect."""
    return f"{angle:g} deg" if current is None else f"{angle:g} deg, {current:g} m/s"


def at_angle(runs: xr.DataArray, angle: float) -> xr.DataArray:
    """Values at a track angle (deg), over the current speed (m/s) if the tracks state it."""
    if "track_angle" in runs.dims:
        return runs.sel(track_angle=angle, drop=True)
    names = {current: track_name(angle, current) for current in CURRENTS}
    tracks = set(runs["track"].values)
    by_speed = {u: runs.sel(track=name, drop=True) for u, name in names.items() if name in tracks}
    if not by_speed:  # across the current, its speed has no effect
        return runs.sel(track=track_name(angle), drop=True)
    speeds = xr.DataArray(list(by_speed), dims="track_current", name="track_current")
    return xr.concat(by_speed.values(), speeds)


def misses_of_print(runs: xr.Dataset, heavy: float, light: float, moment: float) -> xr.Dataset:
    """Relative error of every printed number, and of the ratio of the two printed distances."""
    x, m = distance(runs), largest(runs).sel(lmrp_mass=140.0, drop=True) / 1e3
    x_heavy, x_light = (x.sel(lmrp_mass=mass, drop=True) for mass in (140.0, 120.0))
    ratios = {
        "x_heavy": x_heavy / heavy,
        "x_light": x_light / light,
        "moment": m / moment,
        "ratio": x_light / x_heavy / (light / heavy),
    }
    return abs(xr.Dataset(ratios) - 1.0)
