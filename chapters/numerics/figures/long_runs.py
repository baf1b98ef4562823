"""Long simulations: error and time of candidates, with published times and target times."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from riserstudy.figures.style import COLOURS, headline, key_below, panels

WANTED = 0.01  # wanted error of the moment
LEAST = 1e-6  # smallest error that is drawn
DECADES = 30.0  # ratio of times below which ticks between powers of ten are labelled


def long_runs(long_runs: xr.Dataset) -> Figure:
    """One panel per case; uniform meshes open, graded filled, fastest run below the wanted error circled."""
    cases = list(dict.fromkeys(long_runs["case"].values.tolist()))
    candidates = list(dict.fromkeys(long_runs["candidate"].values.tolist()))
    figure, axes = panels(len(cases), 1, height=2.9)
    for k, (ax, case) in enumerate(zip(axes, cases, strict=True)):
        here = long_runs.isel(run=np.flatnonzero(long_runs["case"].values == case))
        _panel(ax, here, candidates)
        ax.set_title(f"({'abcdef'[k]}) {case}{_lowest_cost(ax, here)}", loc="left", fontsize="medium")
    axes[-1].set_xlabel("CPU time of a run (s)")
    key_below(figure, axes[0], 3)
    headline(figure, answer(long_runs))
    return figure


def answer(long_runs: xr.Dataset) -> str:
    """Title: time of the cheapest accurate run of each case, and the published time."""
    cases = dict.fromkeys(long_runs["case"].values.tolist())
    for case in cases:
        of = long_runs.isel(run=np.flatnonzero(long_runs["case"].values == case))
        published, best = float(of["published_seconds"][0]), _quickest(of)
        if np.isfinite(published) and best is not None:
            seconds = float(of["cpu_seconds"][best])
            return f"The paper's run takes {seconds:.2g} s instead of {published / 3600:.0f} h"
    met = sum(
        _quickest(long_runs.isel(run=np.flatnonzero(long_runs["case"].values == case))) is not None
        for case in cases
    )
    return f"{met} of {len(cases)} long runs have an accurate setting"


def _panel(ax: Axes, of: xr.Dataset, candidates: list[str]) -> None:
    error = np.maximum(of["error_moment"].values, LEAST)
    labels = of["candidate"].values
    for k, label in enumerate(candidates):
        here = labels == label
        filled = "even" not in label
        colour = COLOURS[k % len(COLOURS)]
        ax.plot(
            of["cpu_seconds"].values[here], error[here], "os^Dv"[k % 5], ms=4.5, color=colour,
            markerfacecolor=colour if filled else "none", label=label,
        )  # fmt: skip
    for name, style in (("published", "-"), ("target", ":")):
        value = float(of[f"{name}_seconds"][0])
        if np.isfinite(value):
            ax.axvline(value, color="black", linestyle=style, linewidth=1.0, label=f"{name} time")
    ax.axhline(WANTED, color="0.5", linewidth=0.8, label="1 %, the default tolerance")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_ylabel("error of the\nmoment (%)")
    ax.yaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{100 * x:g}"))
    ax.yaxis.set_minor_formatter(NullFormatter())
    few = np.nanmax(of["cpu_seconds"].values) < DECADES * np.nanmin(of["cpu_seconds"].values)
    if few and not np.isfinite(of["published_seconds"][0]):
        ax.xaxis.set_minor_locator(LogLocator(subs=(2.0, 3.0, 5.0)))
        ax.xaxis.set_major_formatter("{x:g}")
        ax.xaxis.set_minor_formatter("{x:g}")


def _quickest(of: xr.Dataset) -> int | None:
    """Index of the run of least CPU time below the wanted error; None if there is none."""
    error, time = of["error_moment"].values, of["cpu_seconds"].values
    good = np.flatnonzero((error <= WANTED) & np.isfinite(time))
    return int(good[np.argmin(time[good])]) if len(good) else None


def _lowest_cost(ax: Axes, of: xr.Dataset) -> str:
    """Circle the run of least CPU time below the wanted error; return its mesh, step and time in words."""
    error, time = of["error_moment"].values, of["cpu_seconds"].values
    best = _quickest(of)
    if best is None:
        return ""
    ax.plot(time[best], max(error[best], LEAST), "o", ms=12, color="black", markerfacecolor="none")
    segments, step = int(of["elements"][best]), float(of["asked_step"][best])
    return f"; circled: {segments} segments, {step:g} s, in {time[best]:.2g} s"
