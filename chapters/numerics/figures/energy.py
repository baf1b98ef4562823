"""Energy by method: largest numerical dissipation, and largest energy residual."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator

from riserstudy.figures.style import COLOURS, headline, key_below

ROUNDING = 1e-14  # share of energy below which only rounding errors remain
PARTS = {"numerical": "numerical dissipation", "unexplained": "energy residual"}


def energy(energy: xr.Dataset) -> Figure:
    """One row per case, one mark per method: largest part over time, relative to the largest energy."""
    cases = [str(case) for case in energy["case"].values]
    figure = Figure((9.8, 0.62 * len(cases) + 1.9), dpi=150, layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    most = largest(energy)
    high = 10.0 * max(float(most[part].max()) for part in PARTS)
    for ax, letter, (part, words) in zip(axes, "ab", PARTS.items(), strict=True):
        _marks(ax, most[part], cases)
        _axis(ax, max(high, 1.0))
        ax.set_title(f"({letter}) {words}", loc="left", fontsize="medium")
    axes[0].set_yticks(range(len(cases)), cases)
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
        f"Energy balances close to {100 * float(most['unexplained'].max()):.1g} %; "
        f"{worst.split()[0]} dissipates up to {100 * float(by.max()):.2g} %"
    )


def _marks(ax: Axes, most: xr.DataArray, cases: list[str]) -> None:
    methods = [str(method) for method in most["method"].values]
    for k, method in enumerate(methods):
        y = np.arange(len(cases)) + 0.13 * (k - 0.5 * (len(methods) - 1))
        share = most.sel({"method": method}).values
        ax.plot(
            np.maximum(share, ROUNDING), y, "osD^v"[k % 5],
            ms=5.5, color=COLOURS[k % len(COLOURS)], label=method,
        )  # fmt: skip
    for edge in range(1, len(cases)):
        ax.axhline(edge - 0.5, color="0.92", linewidth=0.8, zorder=0)


def _axis(ax: Axes, high: float) -> None:
    """Set the axis of shares in per cent; its lowest tick is the level of rounding."""
    ticks = [1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0]
    ax.set_xscale("log")
    ax.set_xlim(0.3 * ROUNDING, high)
    ax.xaxis.set_major_locator(FixedLocator([ROUNDING, *ticks]))
    ax.xaxis.set_minor_locator(NullLocator())
    powers = (round(np.log10(100.0 * tick)) for tick in ticks)
    ax.set_xticklabels(["rounding", *(f"$10^{{{power}}}$" for power in powers)])
    ax.tick_params(axis="y", length=0)
    ax.grid(True, axis="x", color="0.92", linewidth=0.6)
    ax.set_axisbelow(True)
    ax.set_xlabel("largest share of the energy exchanged or stored (%)")
