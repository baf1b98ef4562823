"""Long simulations: error and time of candidates, with published times and target times."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullFormatter

from chapters.numerics.figures.methods import look_of
from riserstudy.figures.style import headline, key_below, log_ticks, panels

WANTED = 0.01  # wanted error of the moment
OWN = "the paper's own"  # candidate with the settings of a paper
LEAST = 1e-6  # smallest error that is drawn


def long_runs(long_runs: xr.Dataset) -> Figure:
    """One panel per case; uniform meshes open, graded filled, fastest run below the wanted error circled."""
    cases = list(dict.fromkeys(long_runs["case"].values.tolist()))
    candidates = list(dict.fromkeys(long_runs["candidate"].values.tolist()))
    figure, axes = panels(len(cases), 1, height=2.7)
    for k, (ax, case) in enumerate(zip(axes, cases, strict=True)):
        here = _of_case(long_runs, case)
        _panel(ax, here, candidates)
        ax.set_title(
            f"({'abcdef'[k]}) {_named(case, here)}{_lowest_cost(ax, here)}", loc="left", fontsize="medium"
        )
        ax.set_xlabel("CPU time of a run (s)")
    _equal_ranges(axes, [_of_case(long_runs, case) for case in cases])
    key_below(figure, axes[0], 3)
    headline(figure, answer(long_runs))
    return figure


def _named(case: str, of: xr.Dataset) -> str:
    """Name of a case; a case is often named by the time that a paper's run took, or by the simulated time."""
    published = float(of["published_seconds"][0])
    if np.isfinite(published):
        return f"a run that took the paper {published / 3600:.0f} h"
    target = "" if np.isfinite(float(of["target_seconds"][0])) else "; no target time"
    return f"simulated time: {case}{target}"


def _of_case(long_runs: xr.Dataset, case: str) -> xr.Dataset:
    return long_runs.isel(run=np.flatnonzero(long_runs["case"].values == case))


def _equal_ranges(axes: list[Axes], cases: list[xr.Dataset]) -> None:
    """Give the panels of cases without a published time one range of times, and all one range of errors."""
    low, high = (end(ax.get_ylim()[k] for ax in axes) for k, end in enumerate((min, max)))
    alike = [
        ax for ax, of in zip(axes, cases, strict=True) if not np.isfinite(of["published_seconds"].values[0])
    ]
    for ax in axes:
        ax.set_ylim(low, high)
    for ax in alike:
        ax.set_xlim(min(one.get_xlim()[0] for one in alike), max(one.get_xlim()[1] for one in alike))


def answer(long_runs: xr.Dataset) -> str:
    """Title: times of the cheapest accurate run and of the paper's setting, both here."""
    cases = list(dict.fromkeys(long_runs["case"].values.tolist()))
    for case in cases:
        of = _of_case(long_runs, case)
        own, best = np.flatnonzero(of["candidate"].values == OWN), _quickest(of)
        if len(own) and best is not None and best != own[0]:
            ratio = float(of["cpu_seconds"][own[0]] / of["cpu_seconds"][best])
            if ratio > 1.0:
                return f"The cheapest accurate setting is {_two_digits(ratio)} times faster than the paper's"
    met = sum(_quickest(_of_case(long_runs, case)) is not None for case in cases)
    return f"{met} of {len(cases)} long runs have an accurate setting"


def _two_digits(value: float) -> str:
    return f"{float(f'{value:.2g}'):g}"


def _panel(ax: Axes, of: xr.Dataset, candidates: list[str]) -> None:
    error = np.maximum(of["error_moment"].values, LEAST)
    labels = of["candidate"].values
    for label in candidates:
        here = labels == label
        filled = "even" not in label
        name = "paper's mesh and step, run here" if label == OWN else label
        mark, colour, _ = look_of(label.partition(",")[0])
        ax.plot(
            of["cpu_seconds"].values[here], error[here], mark, ms=4.5, color=colour,
            markerfacecolor=colour if filled else "none", label=name,
        )  # fmt: skip
    target, published = (float(of[f"{name}_seconds"][0]) for name in ("target", "published"))
    if np.isfinite(target):
        ax.axvline(target, color="black", linestyle=":", linewidth=1.0, label="target time")
    ax.axhline(WANTED, color="0.5", linewidth=0.8, label="1 %, the default tolerance")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_ylabel("error of the\nmoment (%)")
    ax.yaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{100 * x:g}"))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.margins(x=0.08, y=0.14)
    if np.isfinite(published):
        ax.annotate(
            f"as the paper states:\n{published / 3600:.0f} h →", (0.99, 0.05), xycoords="axes fraction",
            ha="right", fontsize="small",
        )  # fmt: skip
    log_ticks(ax.xaxis)
    ax.xaxis.set_major_formatter("{x:g}")


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
    said = f"\ncircled: {segments} segments, step {step:g} s, CPU time {time[best]:.2g} s"
    return said + f", error {100.0 * error[best]:.2g} %"
