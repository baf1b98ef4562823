"""Long simulations: error and time of candidates, with published times and target times."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullFormatter

from chapters.numerics.answers import OWN
from chapters.numerics.figures.methods import look_of
from riserstudy.figures.style import headline, key_below, log_ticks, panel_title, panels

WANTED = 0.01  # wanted error of the moment
IN_WAVES = "46 hours"  # case that is named by the run time of its paper
EVEN, GRADED = "even", "graded"  # meshes of the candidates; the mesh of a paper, which is uniform, is ""
METHODS = {"gen.-alpha 0.8": "generalised-alpha"}  # in the key
NEAR = 0.15  # share of the axis from which words are at the left of a mark
LEAST = 1e-6  # smallest error that is drawn


def long_runs(long_runs: xr.Dataset, papers_settings: xr.Dataset) -> Figure:
    """One panel per case; uniform meshes open, graded filled, fastest run below the wanted error circled."""
    long_runs = xr.concat([papers_settings, long_runs], "run", combine_attrs="drop")
    cases = list(dict.fromkeys(long_runs["case"].values.tolist()))
    candidates = list(dict.fromkeys(_candidates(long_runs)))
    figure, axes = panels(len(cases), 1, height=2.7)
    for ax, case in zip(axes, cases, strict=True):
        here = _of_case(long_runs, case)
        _panel(ax, here, candidates)
        panel_title(ax, _named(case, here))
        ax.set_xlabel("CPU time of a run (s)")
    low, high = (end(ax.get_ylim()[k] for ax in axes) for k, end in enumerate((min, max)))
    for ax, case in zip(axes, cases, strict=True):
        ax.set_ylim(low, high)
        _circle(ax, _of_case(long_runs, case))
    key_below(figure, axes[0], 2)
    headline(figure, answer(long_runs))
    return figure


def _named(case: str, of: xr.Dataset) -> str:
    """Name of a case; a case is named by the time that a paper's run took, or by the simulated time.

    A preview simulates a part of the time, with which the run time of the paper cannot be compared.
    """
    published = float(of["published_seconds"].max())
    if np.isfinite(published):
        return f"riser in waves; the paper states a run time of {published / 3600:.0f} h"
    if case == IN_WAVES:
        return "riser in waves, for a part of the simulated time of the paper"
    return f"riser in surge, simulated for {case.replace(' in space', ', in three dimensions')}"


def _of_case(long_runs: xr.Dataset, case: str) -> xr.Dataset:
    return long_runs.isel(run=np.flatnonzero(long_runs["case"].values == case))


def _candidates(long_runs: xr.Dataset) -> list[tuple[str, str]]:
    """Method and kind of mesh of each run."""
    return list(zip(*(long_runs[name].values.tolist() for name in ("method", "mesh")), strict=True))


def answer(long_runs: xr.Dataset) -> str:
    """Title: the kind of mesh that has the wanted error, if it is one kind, else the number of cases with it.

    CPU times, which differ from computer to computer, do not change it.
    """
    cases = list(dict.fromkeys(long_runs["case"].values.tolist()))
    error = f"{100 * WANTED:g} %"
    met = [case for case in cases if _quickest(_of_case(long_runs, case)) is not None]
    good = long_runs["error_moment"].values <= WANTED
    if met == cases and (long_runs["mesh"].values[good] == GRADED).all():
        return f"In long simulations, only graded meshes reach a moment error below {error}"
    return f"{len(met)} of {len(cases)} long simulations reach a moment error below {error}"


def _panel(ax: Axes, of: xr.Dataset, candidates: list[tuple[str, str]]) -> None:
    error = np.maximum(of["error_moment"].values, LEAST)
    for method, mesh in candidates:
        here = np.array([one == (method, mesh) for one in _candidates(of)])
        mark, colour, _ = look_of(method)
        ax.plot(
            of["cpu_seconds"].values[here], error[here], mark, ms=7 if method == OWN else 4.5, color=colour,
            markerfacecolor="none" if mesh == EVEN else colour, label=_in_words(method, mesh),
        )  # fmt: skip
    target = float(of["target_seconds"].max())
    if np.isfinite(target):
        ax.axvline(target, color="black", linestyle=":", linewidth=1.0, label="target time")
    ax.axhline(WANTED, color="0.5", linewidth=0.8, label=f"{100 * WANTED:g} %, the default tolerance")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_ylabel("error of the\nmoment (%)")
    ax.yaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{100 * x:g}"))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.margins(x=0.1, y=0.14)
    log_ticks(ax.xaxis)
    ax.xaxis.set_major_formatter("{x:g}")


def _in_words(method: str, mesh: str) -> str:
    """Name of a candidate in the key."""
    if method == OWN:
        return "paper's mesh and time step, on this computer"
    return f"{METHODS.get(method, method)}, {'uniform' if mesh == EVEN else mesh} mesh"


def _quickest(of: xr.Dataset) -> int | None:
    """Index of the run of least CPU time below the wanted error; None if there is none."""
    error, time = of["error_moment"].values, of["cpu_seconds"].values
    good = np.flatnonzero((error <= WANTED) & np.isfinite(time))
    return int(good[np.argmin(time[good])]) if len(good) else None


def _circle(ax: Axes, of: xr.Dataset) -> None:
    """Circle the run of least CPU time below the wanted error, and write its mesh and step next to it."""
    error, time = of["error_moment"].values, of["cpu_seconds"].values
    best = _quickest(of)
    if best is None:
        return
    at = float(time[best]), max(float(error[best]), LEAST)
    label = f"cheapest run below {100 * WANTED:g} %"
    ax.plot(*at, "o", ms=12, color="black", markerfacecolor="none", lw=0, label=label)
    segments, step = int(of["elements"][best]), float(of["asked_step"][best])
    right = ax.transAxes.inverted().transform(ax.transData.transform(at))[0] > NEAR
    ax.annotate(
        f"{segments} segments,\nstep {step:g} s", at, xytext=(-9 if right else 9, -3), va="top",
        textcoords="offset points", ha="right" if right else "left", fontsize="small",
    )  # fmt: skip
