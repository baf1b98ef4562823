"""Energy by method: largest numerical dissipation, and largest energy residual."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator

from chapters.numerics.figures.methods import IN_KEYS, look_of, short_name
from riserstudy.figures.style import WIDE, WIDTH, headline, key_below
from riserstudy.records.numerals import rounded_up

LEAST = 1e-10  # smallest share of energy that is drawn
TICKS = (1e-8, 1e-6, 1e-4, 1e-2, 1.0)  # shares of energy
OPEN = ("gen.-alpha 1",)  # methods with open marks, of a family with several
PARTS = {"numerical": "numerical dissipation", "unexplained": "energy residual"}


def energy(energy: xr.Dataset) -> Figure:
    """One row per case, one mark per method: largest part over time, relative to the largest energy."""
    cases = [str(case) for case in energy["case"].values]
    figure = Figure((WIDE * WIDTH, 0.62 * len(cases) + 1.9), dpi=150, layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    most = largest(energy)
    for ax, letter, (part, words) in zip(axes, "ab", PARTS.items(), strict=True):
        _marks(ax, most[part], cases)
        _axis(ax, most[part])
        ax.set_title(f"({letter}) {words}", loc="left", fontsize="small")
    axes[0].set_yticks(range(len(cases)), cases)
    _absent(axes[0], most["numerical"])
    axes[0].set_ylim(len(cases) - 0.5, -0.5)
    headline(figure, answer(energy))
    key_below(figure, axes[0], 5)
    return figure


def largest(energy: xr.Dataset) -> xr.Dataset:
    """Largest share of either part over time, for each case and method, relative to the largest energy."""
    scale = xr.concat([energy["exchanged"], abs(energy["stored"])], "part").max(["part", "instant"])
    return xr.Dataset({part: abs(energy[part]).max("instant") / scale for part in PARTS})


def answer(energy: xr.Dataset) -> str:
    """Title: largest energy residual, and the method with the largest numerical dissipation."""
    most = largest(energy)
    by = most["numerical"].max("case")
    worst = str(by["method"].values[int(np.nanargmax(by.values))])
    return (
        f"Energy residuals are at most {rounded_up(100 * float(most['unexplained'].max()))} %; "
        f"{short_name(worst)} dissipates up to {100 * float(by.max()):.2g} %"
    )


def _marks(ax: Axes, most: xr.DataArray, cases: list[str]) -> None:
    methods = [str(method) for method in most["method"].values]
    for k, method in enumerate(methods):
        y = np.arange(len(cases)) + 0.13 * (k - 0.5 * (len(methods) - 1))
        share = most.sel({"method": method}).values
        mark, colour, _ = look_of(method)
        ax.plot(
            np.maximum(share, LEAST), y, mark, ms=5.5, color=colour, label=IN_KEYS.get(method, method),
            markerfacecolor="none" if method in OPEN else colour,
        )  # fmt: skip
    for edge in range(1, len(cases)):
        ax.axhline(edge - 0.5, color="0.92", linewidth=0.8, zorder=0)


def _absent(ax: Axes, most: xr.DataArray) -> None:
    """Name the methods that have no mark in a row, because they are unstable with its step."""
    for row, case in enumerate(most["case"].values):
        of = most.sel({"case": case})
        if absent := [str(method) for method in of["method"].values[np.isnan(of.values)]]:
            ax.annotate(
                f"{', '.join(absent)}: unstable", (0.0, row), xycoords=("axes fraction", "data"),
                xytext=(5.0, 0.0), textcoords="offset points", va="center", fontsize="small",
            )  # fmt: skip


def _axis(ax: Axes, share: xr.DataArray) -> None:
    """Set the axis of shares in per cent, around the marks; its lowest tick also has smaller values."""
    values = np.maximum(share.values[np.isfinite(share.values)], LEAST)
    low, high = (float(end) for end in (values.min(), values.max()))
    ticks = [tick for tick in TICKS if 0.03 * low <= tick <= 30.0 * high]
    at_least = low < TICKS[0]
    ax.set_xscale("log")
    ax.set_xlim(0.3 * LEAST if at_least else 0.03 * low, 30.0 * high)
    ax.xaxis.set_major_locator(FixedLocator([*([LEAST] if at_least else []), *ticks]))
    ax.xaxis.set_minor_locator(NullLocator())
    words = [f"$10^{{{round(np.log10(100.0 * tick))}}}$" for tick in ticks]
    lowest = rf"$\leq 10^{{{round(np.log10(100.0 * LEAST))}}}$"
    ax.set_xticklabels([*([lowest] if at_least else []), *words])
    ax.tick_params(axis="y", length=0)
    ax.grid(True, axis="x", color="0.92", linewidth=0.6)
    ax.set_axisbelow(True)
    ax.set_xlabel("largest share of the energy\nexchanged or stored (%)")
