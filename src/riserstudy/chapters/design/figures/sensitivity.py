"""Design, sensitivity: bars of what one input at a time moves."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, headline, panels

BASE = "base"
LEAST = 0.005  # share of the largest effect that is worth a bar


def sensitivity(sensitivity: xr.Dataset) -> Figure:
    """Gap of the tension window and room for drilling, the inputs that move them most above."""
    figure, axes = panels(1, 2, 5.0)
    gap, room = sensitivity["setting_gap"] / 1e6, sensitivity["drilling_room"]
    most = [_bars(ax, values) for ax, values in zip(axes, (gap, room), strict=True)]
    axes[0].set_ylabel("input, from one end of its range to the other (-)")
    axes[0].set_xlabel("gap between floor and ceiling of the setting (MN)")
    axes[1].set_xlabel("room for drilling in 1 m/s (m)")
    headline(
        figure,
        f"The tension window hangs most on the {most[0]}, the room for drilling on the {most[1]}",
    )
    return figure


def _bars(ax: Axes, values: xr.DataArray) -> str:
    """A row an input, a bar to each of its ends; the name of the one that moves most."""
    base = float(values.sel(varied_input=BASE))
    inputs: dict[str, dict[str, float]] = {}
    for label in values["varied_input"].values:
        if label != BASE:
            name, value = str(label).split(", ", 1)
            inputs.setdefault(name, {})[value] = float(values.sel(varied_input=label))
    effect = {name: max(abs(v - base) for v in ends.values()) for name, ends in inputs.items()}
    largest = max(effect.values())
    shown = sorted((n for n in effect if effect[n] > LEAST * largest), key=lambda n: effect[n])
    for row, name in enumerate(shown):
        for colour, (value, there) in zip(COLOURS, inputs[name].items(), strict=False):
            ax.barh(row, there - base, left=base, color=colour, alpha=0.8, height=0.7)
            if abs(there - base) > LEAST * largest:
                side = "left" if there > base else "right"
                ax.annotate(
                    value,
                    (there, row),
                    (3 if there > base else -3, 0),
                    textcoords="offset points",
                    ha=side,
                    va="center",
                    fontsize="x-small",
                )
    ax.axvline(base, color="black", linewidth=0.8)
    ax.set_yticks(np.arange(len(shown)), shown, fontsize="small")
    ax.margins(x=0.32)
    ax.grid(visible=False, axis="y")
    return shown[-1]
