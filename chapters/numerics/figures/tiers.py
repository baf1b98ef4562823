"""Run time and error of each tier."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from riserstudy.figures.style import COLOURS, headline, key_below, log_ticks, panels

LEAST = 1e-7  # smallest error that is drawn
ROW, FRAME = 0.3, 1.7  # inches: height of a row, and of the rest
APART = 0.28  # distance between tiers, as a share of a row
ALIKE = 0.05  # difference from one below which a ratio of times counts as one


def tiers(tiers: xr.Dataset) -> Figure:
    """One row per scene, one colour per tier: time, estimated error, and error of the peaks."""
    figure, (left, right) = panels(1, 2, height=FRAME + ROW * tiers.sizes["scene"])
    places = np.arange(tiers.sizes["scene"])
    for k, tier in enumerate(tiers["tier"].values):
        of = tiers.sel(tier=tier)
        colour, marker = COLOURS[k], "os^"[k % 3]
        rows = places + APART * (k - 0.5 * (tiers.sizes["tier"] - 1))  # all stay visible
        left.plot(of["wall_seconds"], rows, marker, color=colour, markersize=6, label=str(tier))
        right.plot(_drawable(of["estimated"]), rows, marker, color=colour, markersize=6)
        peaks = _drawable(of["error"].max("quantity"))
        right.plot(peaks, rows, marker, color=colour, markersize=6, markerfacecolor="none")
    left.set_yticks(
        places, [str(scene).replace(" deg", "°") for scene in tiers["scene"].values], fontsize="small"
    )
    right.set_yticks(places, [""] * len(places))
    _across(left, "time of all runs (s)", 1.0)
    _across(right, "largest error (%): estimated\n(filled), of peaks (open)", 100.0)
    headline(figure, answer(tiers))
    key_below(figure, left, 3)
    return figure


def answer(tiers: xr.Dataset) -> str:
    """Title: median ratio of times of the finest and the coarsest tier, over the scenes that both can run."""
    first, last = str(tiers["tier"].values[0]), str(tiers["tier"].values[-1])
    if first == last:
        spent = float(tiers["wall_seconds"].median())
        return f"The median run time of a scene in the {first} tier is {spent:.2g} s"
    ratio = (tiers["wall_seconds"].sel(tier=last) / tiers["wall_seconds"].sel(tier=first)).dropna("scene")
    if not ratio.size:
        return f"No scene was simulated at both {first} and {last}"
    middle = float(ratio.median())
    if abs(middle - 1.0) <= ALIKE:
        return f"In the median, a scene takes about as long in the {last} tier as in {first}"
    times = f"{middle:.2g}"
    return f"In the median, a scene takes {times} times as long in the {last} tier as in {first}"


def _drawable(error: xr.DataArray) -> xr.DataArray:
    return error.clip(min=LEAST)


def _across(ax: Axes, label: str, factor: float) -> None:
    ax.set_xscale("log")
    ax.set_xlabel(label)
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{factor * x:g}"))
    log_ticks(ax.xaxis)
    ax.margins(y=0.1 if ax.get_yticks().size > 2 else 0.4)
    ax.invert_yaxis()
