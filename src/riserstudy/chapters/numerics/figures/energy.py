"""Energy over time, by method."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, key_below, panels

LEAST = 1e-17  # share of energy that is drawn, at least


def energy(energy: xr.Dataset) -> Figure:
    """A row a case: numerical dissipation, and what stays unexplained, over the largest energy."""
    cases = energy["case"].values
    figure, axes = panels(len(cases), 2, height=2.7)
    for row, case in enumerate(cases):
        of = energy.sel(case=case)
        scale = xr.concat([of["exchanged"], abs(of["stored"])], "part").max(["part", "instant"])
        for ax, part, word in (
            (axes[2 * row], "numerical", "dissipated by the method"),
            (axes[2 * row + 1], "unexplained", "unexplained"),
        ):
            for k, method in enumerate(energy["method"].values):
                at = {"method": method}
                share = np.maximum(abs(of[part].sel(at)) / scale.sel(at), LEAST)
                ax.plot(
                    of["time"], share, "o-", ms=3, color=COLOURS[k % len(COLOURS)], label=method
                )
            ax.set_yscale("log")
            ax.set_title(f"{case}: {word}", fontsize="medium")
        axes[2 * row].set_ylabel("share of energy (-)")
    for ax in axes[-2:]:
        ax.set_xlabel("time (s)")
    key_below(figure, axes[0], 5)
    return figure
