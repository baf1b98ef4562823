"""What each tier costs and how far off it is."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, key_below, panels

LEAST = 1e-7  # error that a mark is drawn at, at least


def tiers(tiers: xr.Dataset) -> Figure:
    """Time and error by tier, a line a scene."""
    figure, (left, right) = panels(1, 2, height=3.8)
    at = np.arange(tiers.sizes["tier"])
    for k, scene in enumerate(tiers["scene"].values):
        of = tiers.sel(scene=scene)
        style: dict[str, Any] = {
            "color": COLOURS[k % len(COLOURS)],
            "marker": "os^Dv<>"[(k + k // len(COLOURS)) % 7],
            "markersize": 5,
        }
        left.plot(at, of["wall_seconds"], label=str(scene), **style)
        right.plot(at, np.maximum(of["estimated"], LEAST), **style)
        error = np.maximum(of["error"].max("quantity"), LEAST)
        right.plot(at, error, linestyle="", markerfacecolor="none", **style)
    left.set_ylabel("wall time of a run, all refinements (s)")
    right.set_ylabel("largest error (-)")
    for ax in (left, right):
        ax.set_yscale("log")
        ax.set_xticks(at, tiers["tier"].values)
    key_below(figure, left, 3)
    return figure
