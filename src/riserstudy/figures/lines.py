"""Extremes of runs over one axis of a grid, with a colour for each point of the other axes."""

from __future__ import annotations

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.figures.grid import along, ends_of, extreme, key, label, laid_out, points, present, read
from riserstudy.figures.style import COLOURS, GREY
from riserstudy.study.plots import USUAL

STYLES = ("-", "--")
PANELS = 4
DENSE = 30  # number of values beyond which no markers are drawn


def lines(dataset: xr.Dataset, of: list[str] | None = None) -> Figure:
    """One panel per quantity: largest (solid) and smallest value (dashed) of each run, or its single value.

    If the sign is a convention, the largest magnitude is drawn.
    """
    (axis,) = along(dataset, 1)
    names = of or present(dataset, USUAL["lines"])[:PANELS]
    figure, axes = laid_out(len(names))
    for ax, name in zip(axes, names, strict=True):
        ends = ends_of(dataset, name)
        extremes = xr.Dataset({end: extreme(dataset, end) for end in ends})
        for end, style in zip(ends, STYLES, strict=False):
            _draw(ax, extremes, end, axis, style)
        ax.set_xlabel(label(dataset[axis]))
        ax.set_ylabel(label(extremes[ends[0]] if len(ends) == 1 else dataset.get(name, extremes[ends[0]])))
    both = any(len(ends_of(dataset, name)) > 1 for name in names)
    for style, word in zip(STYLES, ("largest", "smallest") if both else (), strict=False):
        axes[0].plot([], [], style, color=GREY, label=word)
    key(figure, axes[0])
    return figure


def _draw(ax: Axes, extremes: xr.Dataset, name: str, axis: str, style: str) -> None:
    """One extreme over the axis."""
    for colour, (called, point) in zip(COLOURS, points(extremes, over=[axis]), strict=False):
        marker = "o" if extremes.sizes[axis] <= DENSE else None
        ax.plot(
            read(point[axis]),
            read(point[name]),
            style,
            color=colour,
            marker=marker,
            markersize=3.0,
            label=called if style == STYLES[0] else None,
        )
