"""Largest and smallest values along the riser, or the state at rest of runs without time."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from riserstudy.figures.grid import ENDINGS, key, label, points, present, read
from riserstudy.figures.style import COLOURS, panels

QUANTITIES = ("x", "y", "bending_moment", "effective_tension", "z")
PANELS = 3


def envelope(dataset: xr.Dataset, of: list[str] | None = None) -> Figure:
    """One panel a quantity, a colour for each of a few points of the grid."""
    names = present(dataset, of or QUANTITIES)[:PANELS]
    figure, axes = panels(1, len(names), 4.2, sharey=True)
    curves = points(dataset)
    for ax, name in zip(axes, names, strict=True):
        ends = [name + end for end in ENDINGS if name + end in dataset] or [name]
        for colour, (called, point) in zip(COLOURS, curves, strict=False):
            for end, word in zip(ends, (called, None), strict=False):
                values = read(point[end].dropna(point[end].dims[-1]))
                ax.plot(values, values[values.dims[-1]], color=colour, label=word)
        ax.set_xlabel(label(dataset[name if name in dataset else ends[0]]))
    axes[0].set_ylabel(label(xr.DataArray(0.0, name="s")))
    key(figure, axes[0])
    return figure
