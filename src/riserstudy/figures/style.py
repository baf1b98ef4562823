"""How figures look: size, colours, letters of panels, legends."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from contextlib import AbstractContextManager
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure

#: colours that stay apart for colour-blind readers and in grey
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
GREY = "#888888"
WIDTH = 6.4  # inches
WIDE = 1.25  # of it, with several columns: at 180 mm, the width of a journal's page, no text is below 6 pt
LETTERS_AN_INCH = 13  # of a headline
SIGNED: dict[str, Any] = {"cmap": "PuOr_r"}
TINT, SHADE = 0.5, 0.5  # shares of white and of black in the first and the last shade of a colour
PRINTED: dict[str, Any] = {"color": "black", "linestyle": (0, (6, 3)), "linewidth": 1.0}


def panels(
    rows: int = 1,
    columns: int = 1,
    height: float = 3.4,
    *,
    sharex: bool = False,
    sharey: bool = False,
) -> tuple[Figure, list[Axes]]:
    """Empty figure with a grid of panels, lettered when there are several."""
    width = WIDTH if columns == 1 else WIDE * WIDTH
    figure = Figure((width, height * rows), dpi=150, layout="constrained")
    grid = figure.subplots(rows, columns, sharex=sharex, sharey=sharey, squeeze=False)
    axes = list(grid.flat)
    for letter, ax in zip("abcdefghijklmno", axes, strict=False):
        _ruled(ax, letter if len(axes) > 1 else "")
    return figure, axes


def mosaic(rows: Sequence[str], heights: Sequence[float]) -> tuple[Figure, list[Axes]]:
    """Empty figure of several columns with panels that may extend over several rows.

    Parameters
    ----------
    rows : the letters of their panels, a column each: ``["a b c", "a b d"]`` has (c) above (d).
    heights : of the rows (inches).

    Returns
    -------
    The figure and its panels by their letters.
    """
    figure = Figure((WIDE * WIDTH, sum(heights)), dpi=150, layout="constrained")
    letters: list[Any] = [row.split() for row in rows]
    placed = figure.subplot_mosaic(letters, height_ratios=list(heights))
    for letter, ax in placed.items():
        _ruled(ax, letter)
    return figure, [placed[letter] for letter in sorted(placed)]


def _ruled(ax: Axes, letter: str) -> None:
    """A panel with thin lines behind its curves and, where it has one, its letter."""
    ax.grid(True, color="0.9", linewidth=0.6)
    ax.set_axisbelow(True)
    if letter:
        ax.set_title(f"({letter})", loc="left", fontsize="small")


def panel_title(ax: Axes, title: str) -> None:
    """Title of a panel, beside its letter where it has one."""
    letter = ax.get_title(loc="left")
    ax.set_title(f"{letter} {title}".strip(), loc="left", fontsize="small")


def shades(colour: str, count: int) -> list[str]:
    """Shades of one colour, light to dark, for lines of one kind in the order of a number."""
    return [
        to_hex((1.0 - abs(share)) * np.array(to_rgb(colour)) + max(-share, 0.0))
        for share in np.linspace(-TINT, SHADE, count)
    ]


def as_written() -> AbstractContextManager[None]:
    """Texts that are made within this are users' own words: a dollar is a dollar and begins no formula."""
    return rc_context({"text.parse_math": False})


def key_below(figure: Figure, ax: Axes, columns: int) -> None:
    """One legend for the whole figure, below its panels; as ``legend_below``."""
    legend_below(figure, *ax.get_legend_handles_labels(), columns)


def legend_below(figure: Figure, handles: list[Any], labels: list[Any], columns: int) -> None:
    """A legend below the panels, in as many columns as fit up to a number."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    for count in range(columns, 0, -1):
        key = figure.legend(
            handles, labels, loc="outside lower center", ncols=count, fontsize="small"
        )
        if count == 1 or key.get_window_extent(renderer).width <= figure.bbox.width:
            return
        key.remove()


def headline(figure: Figure, text: str) -> None:
    """What a reader should see, over all panels."""
    letters = int(LETTERS_AN_INCH * figure.get_size_inches()[0])
    figure.suptitle(textwrap.fill(text, letters), fontsize="medium")


def field(
    figure: Figure,
    ax: Axes,
    values: xr.DataArray,
    across: str,
    up: str,
    label: str,
    signed: float | None = None,
) -> None:
    """A quantity in colours over two of its coordinates, with a bar that says its unit.

    Parameters
    ----------
    figure, ax : where it is drawn.
    values : over both coordinates.
    across, up : names of the coordinates.
    label : of the bar; empty: no bar, where another panel has it.
    signed : largest size, by which colours leave white to either side; absent: from least to most.
    """
    displayed = values.transpose(up, across)
    scale = {"cmap": "viridis"} if signed is None else SIGNED | {"vmin": -signed, "vmax": signed}
    colours = ax.pcolormesh(
        displayed[across], displayed[up], displayed, shading="gouraud", rasterized=True, **scale
    )
    if label:
        figure.colorbar(colours, ax=ax, label=label)
    ax.grid(False)
