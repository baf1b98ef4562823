"""Extremes of the runs in colours over two axes of a grid."""

from __future__ import annotations

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.figures.grid import (
    ENDINGS,
    SIZE,
    along,
    ends_of,
    extreme,
    label,
    laid_out,
    places_of,
    points,
    present,
    read,
)
from riserstudy.study.plots import EXTREMES

PANELS = 4
LEAST = 1e-3  # share of a value that the colours tell apart


def heat_map(dataset: xr.Dataset, of: list[str] | None = None) -> Figure:
    """One panel a quantity; where the grid has a third axis, the first quantity at some of its points."""
    across, up = along(dataset, 2)
    names = of or present(dataset, EXTREMES)[:PANELS]
    ends = [
        n
        if ends_of(dataset, n) == [n] or n.endswith((*ENDINGS, SIZE))
        else n + EXTREMES.get(n, "_max")
        for n in names
    ]
    extremes = xr.Dataset({end: extreme(dataset, end) for end in ends})
    slices = points(extremes, over=[across, up])
    shown = [
        (called, point[end])
        for called, point in slices
        for end in ends[: 1 if slices[1:] else None]
    ]
    figure, axes = laid_out(len(shown))
    for ax, (called, values) in zip(axes, shown, strict=True):
        _draw(figure, ax, values.transpose(up, across))
        ax.set_title(called, loc="right", fontsize="small")
    return figure


def _draw(figure: Figure, ax: Axes, values: xr.DataArray) -> None:
    up, across = (values[dim] for dim in values.dims)
    x, y = places_of(across, ax.set_xticks), places_of(up, ax.set_yticks)
    low, high = float(read(values).min()), float(read(values).max())
    apart = max(high - low, LEAST * abs(high))  # differences by rounding are none
    colours = ax.pcolormesh(
        x, y, read(values), shading="nearest", cmap="viridis", vmin=high - apart, vmax=high
    )
    figure.colorbar(colours, ax=ax, label=label(values))
    ax.set_xlabel(label(across))
    ax.set_ylabel(label(up))
    ax.grid(False)
