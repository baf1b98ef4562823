"""Explicit stepping at its limit: the longest stable step, measured and predicted."""

from __future__ import annotations

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from riserstudy.figures.style import COLOURS, headline, key_below, panels

UNSAFE = 1.0  # measured / predicted step, below which the prediction is too long
ALIKE = 0.1  # difference (%) below which steps count as equal


def stable_step(stable_step: xr.Dataset) -> Figure:
    """Ratio of the measured to the predicted step over the segments, one line per variant."""
    figure, axes = panels(1, 1, height=3.8)
    ax = axes[0]
    ratio = stable_step["measured"] / stable_step["predicted"]
    for row, variant in enumerate(stable_step["variant"].values):
        ax.plot(
            stable_step["elements"].sel(variant=variant),
            ratio.sel(variant=variant),
            "osD^v<>pPX*h"[row % 12] + "-",
            markersize=5,
            linewidth=1.0,
            color=COLOURS[row % len(COLOURS)],
            label=str(variant).replace(" x", " × "),
        )
    ax.axhline(UNSAFE, color="0.4", linewidth=0.8)
    ax.set_xscale("log")
    ticks = sorted({int(n) for n in stable_step["elements"].values.ravel() if n == n})
    ax.set_xticks(ticks, [str(n) for n in ticks])
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.set_xlabel("number of segments")
    ax.set_ylabel("measured / predicted stable step")
    _count_alike(ax, stable_step["elements"], ratio)
    headline(figure, answer(ratio))
    key_below(figure, ax, 4)
    return figure


def _count_alike(ax: Axes, elements: xr.DataArray, ratio: xr.DataArray) -> None:
    """Write how many lines coincide because the measured step equals the prediction."""
    off = abs(ratio - UNSAFE) >= ALIKE / 100.0
    alike = ~off.any([dim for dim in ratio.dims if dim != "variant"])
    count = int(alike.sum())
    if count > 1:
        first = float(elements.where(alike).min())
        ax.annotate(
            f"{count} of {ratio.sizes['variant']} lines coincide, to {ALIKE:g} %", (first, UNSAFE),
            xytext=(0, 10), textcoords="offset points", fontsize="small",
        )  # fmt: skip


def answer(ratio: xr.DataArray) -> str:
    """Title: largest difference of measured and predicted stable step, and whether it is safe."""
    low, high = (100.0 * (float(end) - UNSAFE) for end in (ratio.min(), ratio.max()))
    if max(abs(low), abs(high)) < ALIKE:
        return f"The longest stable explicit step is as predicted, to {ALIKE:g} %"
    if low < -ALIKE:
        return f"The predicted stable step is up to {-low:.1f} % too long"
    return f"The longest stable step exceeds the prediction by up to {high:.1f} %"
