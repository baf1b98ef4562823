"""Extremes of runs as colours over two axes of a grid."""

from __future__ import annotations

from typing import NamedTuple

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.dataset.unit_systems import read_in
from riserstudy.dataset.variables import attributes
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
from riserstudy.figures.range_graph import RED
from riserstudy.figures.style import panel_title
from riserstudy.figures.until_a_disconnect import limits_of_all_times
from riserstudy.scene.limits import SIGNED
from riserstudy.study.plots import EXTREMES

PANELS = 4
LEAST = 1e-3  # smallest relative difference that colours show


def heat_map(dataset: xr.Dataset, of: list[str] | None = None) -> Figure:
    """One panel per quantity; for a grid with a third axis, the first quantity at some of its points."""
    across, up = along(dataset, 2)
    names = of or present(dataset, EXTREMES)[:PANELS]
    ends = [
        n if ends_of(dataset, n) == [n] or n.endswith((*ENDINGS, SIZE)) else n + EXTREMES.get(n, "_max")
        for n in names
    ]
    extremes = xr.Dataset({end: extreme(dataset, end) for end in ends})
    slices = points(extremes, over=[across, up])
    displayed = [
        (called, point[end]) for called, point in slices for end in ends[: 1 if slices[1:] else None]
    ]
    figure, axes = laid_out(len(displayed))
    ranges = {end: _range(extremes[end]) for end in ends}
    for ax, (called, values) in zip(axes, displayed, strict=True):
        end = str(values.name)
        _draw(figure, ax, values.transpose(up, across), ranges[end], _allowables(dataset, end))
        panel_title(ax, called)
    return figure


class Range(NamedTuple):
    """The colour scale of a quantity, the same in all its panels."""

    low: float
    high: float
    colours: str


def _range(values: xr.DataArray) -> Range:
    """From the smallest to the largest value; symmetric about zero, in two colours, if both signs occur."""
    displayed = read(values)
    low, high = float(displayed.min()), float(displayed.max())
    if _quantity(str(values.name)) in SIGNED and low < 0.0 < high:
        most = max(-low, high)
        return Range(-most, most, "RdBu_r")
    apart = max(high - low, LEAST * abs(high))  # ignores differences by rounding
    return Range(high - apart, high, "viridis")


def _quantity(name: str) -> str:
    for ending in (*ENDINGS, SIZE):
        name = name.removesuffix(ending)
    return name


def _allowables(dataset: xr.Dataset, name: str) -> list[float]:
    """Allowables of a quantity for the whole riser, in the reader's unit, on the side that is shown.

    The values that are shown do not tell whether a limit that ends with a disconnect is exceeded.
    """
    quantity = _quantity(name)
    sides = {"": ("largest", "smallest"), "_max": ("largest",), "_min": ("smallest",)}
    # the magnitude has a limit of quantities whose sign is a convention, and of these alone
    side = ("largest",) if quantity in SIGNED else sides.get(name.removeprefix(quantity), ())
    factor = read_in(attributes(quantity).get("units", "")).factor
    levels = [
        factor * row["allowable"]
        for _, row in limits_of_all_times(dataset)
        if row["output"] == quantity
        and not row["at"]
        and row["side"] in side
        and row["allowable"] is not None
    ]
    both = quantity in SIGNED and not name.endswith(SIZE)
    return sorted({*levels, *(-level for level in levels if both)})


def _draw(figure: Figure, ax: Axes, values: xr.DataArray, levels: Range, limits: list[float]) -> None:
    up, across = (values[dim] for dim in values.dims)
    x, y = places_of(across, ax.set_xticks), places_of(up, ax.set_yticks)
    displayed = read(values)
    colours = ax.pcolormesh(
        x, y, displayed, shading="nearest", cmap=levels.colours, vmin=levels.low, vmax=levels.high
    )
    bar = figure.colorbar(colours, ax=ax, label=label(values))
    for level in limits:
        if levels.low <= level <= levels.high:
            bar.ax.axhline(level, color=RED, linewidth=1.4)
        if min(displayed.shape) > 1 and float(displayed.min()) < level < float(displayed.max()):
            ax.contour(x, y, displayed, levels=[level], colors=[RED], linewidths=1.2)
    ax.set_xlabel(label(across))
    ax.set_ylabel(label(up))
    ax.grid(False)
