"""Measures along a riser: angles, stresses, amplitudes, and the positions of their largest values."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray as xr

from riserstudy.dataset.extremes import largest_size
from riserstudy.scene.units import to_si

DISTINCT = 5.0  # condition number of fitted motions up to which outputs distinguish them
SPAN = 35.0  # s, from the mean over a wave around 261 s to the mean around 296 s


def measures(runs: xr.Dataset) -> xr.Dataset:
    """Quantities of the claims, for every run of a study.

    Largest deflection (m), stress (Pa) and angle (rad) over the record. Vibration (m): the largest amplitude
    at the wave's period. Drift: change of the mid-length deflection from 261 to 296 s, divided by its mean,
    both relative to the line between the ends. Positions as shares of the length: of the largest deflection,
    from the vertical and from this line, from the bottom; of the largest stress and angle from the bottom
    (lower half) and the top (upper half).
    """
    s = runs["s_node"] / runs["s_node"][-1]
    deflection, from_line = extreme(runs, "x"), _from_line(runs)
    factor = stress_factor(runs)
    stress = factor * extreme(runs, "bending_moment")
    slope = abs(angles(runs)).max("time")
    period = period_of(runs)
    mid = runs["x"].sel(s=0.5 * float(runs["s"][-1]), method="nearest", drop=True)
    mid = mid - 0.5 * (runs["x"].isel(s=0, drop=True) + runs["x"].isel(s=-1, drop=True))
    return xr.Dataset(
        {
            "deflection": _largest(runs, "x"),
            "deflection_from_line": from_line.max("s_node"),
            "deflection_place": place(deflection, s, "s_node", s >= 0.0),
            "deflection_from_line_place": place(from_line, s, "s_node", s >= 0.0),
            "vibration": amplitude_at(runs["x"], period).max("s"),
            "drift": SPAN * abs(drift_rate(mid, period) / mid.mean("time")),
            "stress": factor * _largest(runs, "bending_moment"),
            "stress_from_bottom": place(stress, s, "s_node", s <= 0.5),
            "stress_from_top": 1.0 - place(stress, s, "s_node", s >= 0.5),
            "angle": slope.max("middle"),
            "angle_from_bottom": place(slope, slope["middle"], "middle", slope["middle"] <= 0.5),
            "angle_from_top": 1.0 - place(slope, slope["middle"], "middle", slope["middle"] >= 0.5),
        }
    ).drop_vars(("s", "s_node", "middle"), errors="ignore")


def extreme(runs: xr.Dataset, name: str) -> xr.DataArray:
    """Largest magnitude in the record, from the envelopes."""
    sides = [abs(runs[f"{name}_{side}"]) for side in ("max", "min")]
    return xr.concat(sides, "side").max("side")


def _from_line(runs: xr.Dataset) -> xr.DataArray:
    """Largest distance (m) from the straight line between the ends; the lower end is at zero."""
    top = runs["x"].isel(s=-1, time=0, drop=True)
    line = top * runs["s_node"] / runs["s_node"][-1]
    sides = [abs(runs[f"x_{side}"] - line) for side in ("max", "min")]
    return xr.concat(sides, "side").max("side")


def _largest(runs: xr.Dataset, name: str) -> xr.DataArray:
    """Largest magnitude at the nodes of each run, if stored; else at the common nodes of the study."""
    own = largest_size(runs, name)
    return extreme(runs, name).max("s_node") if own is None else own


def angles(runs: xr.Dataset) -> xr.DataArray:
    """Angle from the vertical (rad) over time and ``middle``, the element centres as shares of the length."""
    s = runs["s"].values
    slope = runs["x"].diff("s") / xr.DataArray(np.diff(s), dims="s")
    middle = 0.5 * (s[1:] + s[:-1]) / s[-1]
    angle: xr.DataArray = xr.apply_ufunc(np.arctan, slope.rename(s="middle"))
    return angle.assign_coords(middle=middle)


def place(values: xr.DataArray, s: xr.DataArray, dim: str, among: xr.DataArray) -> xr.DataArray:
    """Position, in the unit of ``s``, of the largest of the values that ``among`` selects."""
    where = values.where(among, -1.0).argmax(dim)
    return xr.DataArray(s.values[where.values], dims=where.dims)


def amplitude_at(x: xr.DataArray, period: float) -> xr.DataArray:
    """Amplitude at a period (s), by a least-squares fit together with a straight line in time."""
    parts = xr.dot(x, _fitting(x, period, 2, 4), dim="time")
    amplitude: xr.DataArray = (parts**2).sum("part") ** 0.5
    return amplitude


def drift_rate(x: xr.DataArray, period: float) -> xr.DataArray:
    """Slope of the fitted line: change per second, without the motion at the period (s)."""
    slope: xr.DataArray = xr.dot(x, _fitting(x, period, 1, 2), dim="time").isel(part=0)
    return slope


def without_drift(x: xr.DataArray, period: float) -> xr.DataArray:
    """Values without the drift of the fitted line; those at the last time are unchanged."""
    left: xr.DataArray = x - drift_rate(x, period) * (x["time"] - x["time"][-1])
    return left


def _fitting(x: xr.DataArray, period: float, first: int, end: int) -> xr.DataArray:
    """Rows of the least-squares fit of a constant, a line, a cosine and a sine to the times of x.

    The riser also moves at multiples of the wave's frequency. In few outputs, these motions look like motion
    at the period, unless they are fitted as well.
    """
    t = x["time"].values
    w = 2.0 * np.pi / period
    basis = np.stack([np.ones_like(t), t - t.mean(), np.cos(w * t), np.sin(w * t)], axis=1)
    for multiple in (2.0, 3.0):
        more = np.stack([np.cos(multiple * w * t), np.sin(multiple * w * t)], axis=1)
        wider = np.concatenate([basis, more], axis=1)
        # outputs that cannot tell a multiple from the other terms, such as four in a period, leave it out
        if len(t) > wider.shape[1] and np.linalg.cond(wider / np.linalg.norm(wider, axis=0)) < DISTINCT:
            basis = wider
    rows = np.linalg.pinv(basis)[first:end]
    return xr.DataArray(rows, dims=("part", "time"), coords={"time": x["time"]})


def period_of(runs: xr.Dataset) -> float:
    """Period of the wave (s)."""
    return to_si(json.loads(runs.attrs["scene"])["wave"]["period"], "s")


def stress_factor(runs: xr.Dataset) -> xr.DataArray:
    """Ratio of the bending stress at the outer fibre to the bending moment, D / 2I (1/m3), of each sample.

    Samples contain a diameter as an assumed value, or as the name of an interpretation, which is a diameter.
    """

    def diameter(name: str) -> Any:
        for varied in (f"assumed_riser_0_{name}", f"assumed_{name}"):
            if varied in runs:
                values = [to_si(str(text), "m") for text in runs[varied].values]
                return xr.DataArray(values, dims=runs[varied].dims)
        return xr.DataArray(to_si(json.loads(runs.attrs["scene"])["riser"][0][name], "m"))

    outer, inner = diameter("outer_diameter"), diameter("inner_diameter")
    factor: xr.DataArray = 32.0 * outer / (np.pi * (outer**4 - inner**4))
    return factor
