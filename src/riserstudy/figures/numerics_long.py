"""Long simulations: error against time over candidates, with what papers name and what is aimed at."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, panels

WANTED = 0.01  # error of the moment
LEAST = 1e-6  # error that a mark is drawn at, at least


def long_runs(long_runs: xr.Dataset) -> Figure:
    """A panel a case; even meshes are open, graded ones filled."""
    cases = list(dict.fromkeys(long_runs["case"].values.tolist()))
    figure, axes = panels(len(cases), 1, height=2.9)
    for ax, case in zip(axes, cases, strict=True):
        _panel(ax, long_runs.isel(run=np.flatnonzero(long_runs["case"].values == case)))
        ax.set_title(case, fontsize="medium")
    axes[-1].set_xlabel("processor time of a run (s)")
    return figure


def _panel(ax: Axes, of: xr.Dataset) -> None:
    error = np.maximum(of["error_moment"].values, LEAST)
    wall = of["cpu_seconds"].values
    labels = of["candidate"].values
    for k, label in enumerate(dict.fromkeys(labels.tolist())):
        here = labels == label
        filled = "even" not in label
        colour = COLOURS[k % len(COLOURS)]
        ax.plot(
            wall[here], error[here], "os^Dv"[k % 5], ms=4.5, color=colour,
            markerfacecolor=colour if filled else "none", label=label,
        )  # fmt: skip
    good = np.flatnonzero((of["error_moment"].values <= WANTED) & np.isfinite(wall))
    if len(good):
        best = good[np.argmin(wall[good])]
        ax.plot(wall[best], error[best], "o", ms=12, color="black", markerfacecolor="none")
        segments, step = int(of["elements"][best]), float(of["asked_step"][best])
        told = f"{segments} segments, {step:g} s: {wall[best]:.2g} s"
        ax.annotate(
            told, (wall[best], error[best]), (8, 8), textcoords="offset points", fontsize="small"
        )
    for name, style in (("published_seconds", "-"), ("target_seconds", ":")):
        value = float(of[name][0])
        if np.isfinite(value):
            ax.axvline(value, color="black", linestyle=style, linewidth=1.0)
    ax.axhline(WANTED, color="0.5", linewidth=0.8)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_ylabel("error of the\nmoment (-)")
    ax.legend(fontsize="x-small", loc="center right")
