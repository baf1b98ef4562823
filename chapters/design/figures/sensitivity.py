"""Design, sensitivity: effect of one input at a time, as bars."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, headline, key_below, panel_title, panels

BASE = "base"
WORDS = {
    "mud": "mud density",
    "LMRP": "LMRP mass",
    "modules lift": "buoyancy module lift",
    "tension": "tension setting",
    "tension limit": "dynamic tension limit",
    "current's depth": "depth of the current",
    "drag": "drag coefficient",
    "lower joint": "lower flex joint stiffness",
    "upper joint": "upper flex joint stiffness",
    "steel's tolerance": "weight factor of steel",
    "modules' tolerance": "lift factor of modules",
    "tension ratio": "reduction factor",
    "units out": "number of failed units",
    "upper joint's allowance": "upper flex joint allowance",
    "lower joint's allowance": "lower flex joint allowance",
}
LEAST = 0.005  # smallest effect that has a bar, as a share of the largest effect


def sensitivity(sensitivity: xr.Dataset) -> Figure:
    """Width of the tension window and of the drilling window, the most influential inputs on top."""
    figure, axes = panels(1, 2, 5.0)
    gap, room = sensitivity["setting_gap"] / 1e6, sensitivity["drilling_room"]
    most = [_bars(ax, values) for ax, values in zip(axes, (gap, room), strict=True)]
    axes[0].set_ylabel("input, with the ends of its range")
    axes[0].set_xlabel("tension window (MN)")
    axes[1].set_xlabel("drilling window (m)")
    panel_title(axes[0], "with one failed unit")
    panel_title(axes[1], "in a current of 1 m/s")
    key_below(figure, axes[0], 3)
    first = most[0][0].upper() + most[0][1:]
    both = (
        f"{first} and {most[1]} affect the windows" if most[0] != most[1] else f"{first} affects both windows"
    )
    headline(figure, f"{both} most")
    return figure


def _bars(ax: Axes, values: xr.DataArray) -> str:
    """Draw one row per input, with a bar to each end of its range; return the most influential input."""
    base = float(values.sel(varied_input=BASE))
    inputs: dict[str, dict[str, float]] = {}
    for label in values["varied_input"].values:
        if label != BASE:
            name, value = str(label).split(", ", 1)
            inputs.setdefault(name, {})[value] = float(values.sel(varied_input=label))
    effect = {name: max(abs(v - base) for v in ends.values()) for name, ends in inputs.items()}
    largest = max(effect.values())
    largest_ones = sorted((n for n in effect if effect[n] > LEAST * largest), key=lambda n: effect[n])
    for row, name in enumerate(largest_ones):
        for colour, end, (value, there) in zip(
            COLOURS, ("lower end", "upper end"), inputs[name].items(), strict=False
        ):
            label = f"{end} of the range" if row == len(largest_ones) - 1 else ""
            ax.barh(row, there - base, left=base, color=colour, alpha=0.8, height=0.7, label=label)
            if abs(there - base) > LEAST * largest:
                side = "left" if there > base else "right"
                ax.annotate(
                    value.replace("/deg", "/°"),
                    (there, row),
                    (3 if there > base else -3, 0),
                    textcoords="offset points",
                    ha=side,
                    va="center",
                    fontsize="x-small",
                )
    ax.axvline(base, color="black", linewidth=0.8, label="all inputs at their assumed values")
    words = [WORDS.get(name, name) for name in largest_ones]
    ax.set_yticks(np.arange(len(words)), words, fontsize="small")
    ax.margins(x=0.8)  # room for the ends of the ranges
    ax.grid(visible=False, axis="y")
    return words[-1]
