"""Utilisation of limits at every point of a grid, and the governing limit."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from numpy.typing import NDArray

from riserstudy.dataset.limits import UNKNOWN
from riserstudy.errors import InputError
from riserstudy.figures.grid import (
    along,
    axes_of,
    evenly_spaced,
    key,
    label,
    laid_out,
    places_of,
    points,
    read,
)
from riserstudy.figures.limit_colours import colours_of
from riserstudy.figures.names import in_words
from riserstudy.figures.style import GREY, headline, panel_title
from riserstudy.records.arrays import FloatArray

SLICES = 4  # number of equally spaced points of a third axis that are shown
MOST = 2.0  # largest utilisation on the scale of colours and lines
DARK = 1.6  # utilisation from which on a number is white
FEW = 60  # number of cells of a panel up to which each has its number


def utilisation(dataset: xr.Dataset, of: list[str] | None = None) -> Figure:
    """Over one axis, a line per limit; over two, the largest utilisation as colours, and the governing limit.

    Raises InputError when the dataset has no limits.
    """
    if "use_of_limit" not in dataset:
        title = str(dataset.attrs.get("title", "dataset"))
        raise InputError(title, "plot", "the dataset has no utilisations", "use a study with limits")
    uses = dataset[["use_of_limit", "point_key"]]
    verdicts = dataset.get("verdict_of_limit")
    figure = _lines(uses) if len(axes_of(dataset)) == 1 else _maps(uses)
    headline(figure, _use_in_words(uses["use_of_limit"], verdicts))
    return figure


def _lines(uses: xr.Dataset) -> Figure:
    figure, (ax,) = laid_out(1)
    (axis,) = along(uses, 1)
    for k, (name, colour) in enumerate(colours_of(uses["limit"].values).items()):
        values = uses["use_of_limit"].isel(limit=k).clip(max=MOST)
        ax.plot(read(uses[axis]), values, "-", color=colour, marker="o", markersize=3.0, label=in_words(name))
    ax.axhline(1.0, color="black", linewidth=0.8)
    ax.set_xlabel(label(uses[axis]))
    ax.set_ylabel("utilisation of a limit\n(values above 2 drawn at 2)")
    key(figure, ax)
    return figure


def _maps(uses: xr.Dataset) -> Figure:
    across, up = along(uses, 2)
    slices = points(uses, over=[across, up])
    chosen = [slices[k] for k in evenly_spaced(len(slices), SLICES)]
    figure, axes = laid_out(2 * len(chosen))
    names = [in_words(str(name)) for name in uses["limit"].values]
    use_at = [point["use_of_limit"].transpose("limit", up, across) for _, point in chosen]
    displayed = sorted({int(k) for use in use_at for k in _which(use).ravel()})
    colours = {-1: GREY} | dict(enumerate(colours_of(uses["limit"].values).values()))
    for row, ((called, _), use) in enumerate(zip(chosen, use_at, strict=True)):
        left, right = axes[2 * row : 2 * row + 2]
        _use(figure, left, use, called)
        _governing(right, use, called, colours)
    for k in reversed(displayed):
        called = names[k] if k >= 0 else "not evaluated"
        axes[1].plot([], [], "s", color=colours.get(k, GREY), label=called)
    key(figure, axes[1])
    return figure


def _use(figure: Figure, ax: Axes, use: xr.DataArray, called: str) -> None:
    largest = use.max("limit")
    x, y = _frame(ax, use, "utilisation of the governing limit", called)
    colours = ax.pcolormesh(
        x, y, largest.clip(max=MOST), shading="nearest", cmap="RdYlGn_r", vmin=0.0, vmax=MOST
    )
    bar = figure.colorbar(colours, ax=ax, label="largest utilisation of a limit", extend="max")
    bar.ax.axhline(1.0, color="black", linewidth=1.2)
    if largest.size <= FEW:
        for j, i in np.ndindex(largest.shape):
            value = float(largest[j, i])
            text = "–" if np.isnan(value) else ">9" if value > 9.0 else f"{value:.2f}"
            ax.text(
                float(x[i]),
                float(y[j]),
                text,
                ha="center",
                va="center",
                fontsize="x-small",
                color="white" if value > DARK else "black",
            )


def _governing(ax: Axes, use: xr.DataArray, called: str, colours: Mapping[int, str]) -> None:
    """Draw the governing limits by their colours; -1 is the colour of cells without one."""
    x, y = _frame(ax, use, "governing limit", called)
    mapped = ListedColormap([colours.get(k, GREY) for k in range(-1, use.sizes["limit"])])
    ax.pcolormesh(x, y, _which(use), shading="nearest", cmap=mapped, vmin=-1.5, vmax=use.sizes["limit"] - 0.5)


def _frame(ax: Axes, use: xr.DataArray, title: str, called: str) -> tuple[FloatArray, FloatArray]:
    _, up, across = (use[dim] for dim in use.dims)
    x, y = places_of(across, ax.set_xticks), places_of(up, ax.set_yticks)
    ax.set_xlabel(label(across))
    ax.set_ylabel(label(up))
    panel_title(ax, f"{title}{', ' if called else ''}{called}")
    ax.grid(False)
    return x, y


def _which(use: xr.DataArray) -> NDArray[np.int64]:
    """Index of the limit with the largest utilisation over the other dimensions, -1 if none is evaluated."""
    values = np.where(np.isnan(use.values), -np.inf, use.values)
    place = use.dims.index("limit")
    return np.where(np.isneginf(values.max(axis=place)), -1, values.argmax(axis=place))


def _use_in_words(use: xr.DataArray, verdicts: xr.DataArray | None) -> str:
    """The number of points that exceed a limit, and the limit that governs most of them.

    The number of other points at which a limit is not evaluated is stated, because nothing is known there.
    """
    largest, which = use.max("limit"), _which(use)
    beyond, all_points = int((largest > 1.0).sum()), largest.size
    if not (which >= 0).any():
        return "no limit is evaluated at any point"
    numbers, counts = np.unique(which[which >= 0], return_counts=True)
    first = int(numbers[counts.argmax()])
    name = in_words(str(use["limit"].values[first]))
    many = "all" if counts.max() == all_points else f"{counts.max()}"
    unknown = use.isnull() if verdicts is None else use.isnull() | (verdicts == UNKNOWN)
    left = int((unknown.any("limit") & ~(largest > 1.0)).sum())
    known = f"; at {left}, a limit is {UNKNOWN}" if left else ""
    return f"{beyond} of {all_points} points exceed a limit{known}; at {many}, {name} governs"
