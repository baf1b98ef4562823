"""Explicit stepping at its limit: the longest stable step, measured and predicted."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from riserstudy.figures.style import COLOURS, key_below, panels

UNSAFE = 1.0  # measured over predicted, below which a predicted step is too long


def stable_step(stable_step: xr.Dataset) -> Figure:
    """Ratio of the measured to the predicted step over the segments, a line a variant."""
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
            label=str(variant),
        )
    ax.axhline(UNSAFE, color="0.4", linewidth=0.8)
    ax.set_xscale("log")
    ticks = sorted({int(n) for n in stable_step["elements"].values.ravel() if n == n})
    ax.set_xticks(ticks, [str(n) for n in ticks])
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.set_xlabel("segments (1)")
    ax.set_ylabel("measured over predicted stable step (1)")
    low, high = float(ratio.min()), float(ratio.max())
    ax.set_title(
        f"The measured stable step is {low:.3f} to {high:.3f} of the predicted one",
        fontsize="medium",
    )
    key_below(figure, ax, 4)
    return figure
