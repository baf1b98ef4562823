"""Run time and error of each tier."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from riserstudy.figures.style import COLOURS, headline, legend_below, log_ticks, panel_title, panels
from riserstudy.records.numerals import rounded_up

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
        for row in np.flatnonzero(np.isnan(of["wall_seconds"].values)):
            left.annotate(
                f"not in {tier}", (0.03, rows[row]), xycoords=("axes fraction", "data"), va="center",
                fontsize="x-small", color=colour,
            )  # fmt: skip
    right.plot([], [], "o", color="0.4", markersize=6, label="(b) estimated error")
    right.plot([], [], "o", color="0.4", markersize=6, markerfacecolor="none", label="(b) error of the peaks")
    left.set_yticks(places, [_in_words(str(scene)) for scene in tiers["scene"].values], fontsize="small")
    right.set_yticks(places, [""] * len(places))
    _across(left, "elapsed time of all runs (s)", 1.0)
    _across(right, "largest error (%)", 100.0)
    headline(figure, answer(tiers))
    panel_title(left, "elapsed time")
    panel_title(right, _peaks(tiers))
    keys = [ax.get_legend_handles_labels() for ax in (left, right)]
    legend_below(figure, [*keys[0][0], *keys[1][0]], [*keys[0][1], *keys[1][1]], 5)
    return figure


def _in_words(scene: str) -> str:
    return scene.replace(" deg", "°").replace("no open inputs", "no unspecified inputs")


def answer(tiers: xr.Dataset) -> str:
    """Title: ratios of times of the finest and the coarsest tier, over the scenes that both can run."""
    first, last = str(tiers["tier"].values[0]), str(tiers["tier"].values[-1])
    if first == last:
        spent = float(tiers["wall_seconds"].median())
        return f"The median run time of a scene in the {first} tier is {spent:.2g} s"
    ratio = (tiers["wall_seconds"].sel(tier=last) / tiers["wall_seconds"].sel(tier=first)).dropna("scene")
    if not ratio.size:
        return f"No scene was simulated at both {first} and {last}"
    low, high = (float(end) for end in (ratio.min(), ratio.max()))
    if max(abs(low - 1.0), abs(high - 1.0)) <= ALIKE:
        return f"{last.capitalize()} takes about as long as {first}"
    words = " to ".join(dict.fromkeys((f"{low:.2g}", f"{high:.2g}")))
    return f"{last.capitalize()} takes {words} times as long as {first}"


def _peaks(tiers: xr.Dataset) -> str:
    """Title of the errors: the largest error of a peak in any tier, rounded up."""
    most = 100.0 * float(tiers["error"].max())
    return f"errors; peaks within {rounded_up(most)} %" if most > 0.0 else "errors"


def _drawable(error: xr.DataArray) -> xr.DataArray:
    return error.clip(min=LEAST)


def _across(ax: Axes, label: str, factor: float) -> None:
    ax.set_xscale("log")
    ax.set_xlabel(label)
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{factor * x:g}"))
    log_ticks(ax.xaxis)
    rows = ax.get_yticks().size
    ax.set_ylim(-0.6, rows - 0.4)
    ax.invert_yaxis()
