"""Style of figures: size, colours, letters of panels, legends."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from contextlib import AbstractContextManager
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from matplotlib.ticker import Locator, LogLocator, MaxNLocator, NullFormatter

#: colours that are distinct for colour-blind readers and in grey
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
GREY = "#888888"
WIDTH = 6.4  # inches
# factor for figures with several columns: at 180 mm, the width of a journal's page, no text is below 6 pt
WIDE = 1.25
SHORT = 4.0  # ratio of the ends of a logarithmic axis on which 1, 2 and 5 are too few marks
WITHIN = (1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0)  # marks of a short axis, in powers of ten
DECADES = 100.0  # ratio of the ends up to which values between powers of ten are marked
LETTERS_AN_INCH = 13  # letters of a headline in an inch
SIGNED: dict[str, Any] = {"cmap": "PuOr_r"}
# from the least to the most; the most contrasts most with the page, also where a dark page inverts colours
ONE_SIGN: dict[str, Any] = {"cmap": "Blues"}
TINT, SHADE = 0.5, 0.5  # shares of white and black in the first and the last shade of a colour
PRINTED: dict[str, Any] = {"color": "black", "linestyle": (0, (6, 3)), "linewidth": 1.0}


def panels(
    rows: int = 1, columns: int = 1, height: float = 3.4, *, sharex: bool = False, sharey: bool = False
) -> tuple[Figure, list[Axes]]:
    """Empty figure with a grid of panels, with letters if there are several."""
    width = WIDTH if columns == 1 else WIDE * WIDTH
    figure = Figure((width, height * rows), dpi=150, layout="constrained")
    grid = figure.subplots(rows, columns, sharex=sharex, sharey=sharey, squeeze=False)
    axes = list(grid.flat)
    for letter, ax in zip("abcdefghijklmno", axes, strict=False):
        _ruled(ax, letter if len(axes) > 1 else "")
    return figure, axes


def mosaic(rows: Sequence[str], heights: Sequence[float]) -> tuple[Figure, list[Axes]]:
    """Empty figure with several columns, whose panels may extend over several rows.

    Parameters
    ----------
    rows : letters of the panels in each row, one per column: ``["a b c", "a b d"]`` has (c) above (d).
    heights : heights of the rows (inches).

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
    """Add thin grid lines, and a letter if there is one, to a panel."""
    ax.grid(True, color="0.9", linewidth=0.6)
    ax.set_axisbelow(True)
    if letter:
        ax.set_title(f"({letter})", loc="left", fontsize="small")


def panel_title(ax: Axes, title: str) -> None:
    """Title of a panel, next to its letter if it has one."""
    letter = ax.get_title(loc="left")
    ax.set_title(f"{letter} {title}".strip(), loc="left", fontsize="small")


def shades(colour: str, count: int) -> list[str]:
    """Shades of one colour from light to dark, for lines of one kind in the order of a number."""
    return [
        to_hex((1.0 - abs(share)) * np.array(to_rgb(colour)) + max(-share, 0.0))
        for share in np.linspace(-TINT, SHADE, count)
    ]


#: the colours, then their light and dark shades, for things of which many may be shown; black has no shades
MANY_COLOURS = (*COLOURS, *(shades(colour, 3)[k] for k in (0, -1) for colour in COLOURS[:-1]))


def as_written() -> AbstractContextManager[None]:
    """Context for texts of users, in which a dollar sign does not begin a formula."""
    return rc_context({"text.parse_math": False})


def key_below(figure: Figure, ax: Axes, columns: int) -> None:
    """One legend for the whole figure, below its panels; as ``legend_below``."""
    legend_below(figure, *ax.get_legend_handles_labels(), columns)


def legend_below(figure: Figure, handles: list[Any], labels: list[Any], columns: int) -> None:
    """A legend below the panels, with as many columns as fit, up to ``columns``."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    for count in range(columns, 0, -1):
        key = figure.legend(handles, labels, loc="outside lower center", ncols=count, fontsize="small")
        if count == 1 or key.get_window_extent(renderer).width <= figure.bbox.width:
            return
        key.remove()


def headline(figure: Figure, text: str) -> None:
    """The finding of a figure, as a title above all panels."""
    letters = int(LETTERS_AN_INCH * figure.get_size_inches()[0])
    figure.suptitle(textwrap.fill(text, letters), fontsize="medium")


def log_ticks(axis: Axis) -> None:
    """Mark the powers of ten of a logarithmic axis that has its data, and 2 and 5 between few of them.

    A short axis, which may contain one of these or none, has more values, or about three evenly spaced ones.
    """
    low, high = axis.get_view_interval()
    subs = (1.0, 2.0, 5.0) if high < DECADES * low else (1.0,)
    locator: Locator = LogLocator(subs=subs)
    if high < SHORT * low:
        decade = 10.0 ** np.floor(np.log10(low))
        marks = np.outer([decade, 10.0 * decade], WITHIN)
        few = np.count_nonzero((marks >= low) & (marks <= high)) < 2
        locator = MaxNLocator(3) if few else LogLocator(subs=WITHIN)
    axis.set_major_locator(locator)
    axis.set_minor_formatter(NullFormatter())  # labels within a decade overlap


def field(
    figure: Figure,
    ax: Axes,
    values: xr.DataArray,
    across: str,
    up: str,
    label: str,
    signed: float | None = None,
) -> None:
    """A quantity as colours over two of its coordinates, with a colour bar that states its unit.

    Parameters
    ----------
    figure, ax : figure and panel.
    values : over both coordinates.
    across, up : names of the coordinates.
    label : label of the colour bar; empty: no bar, since another panel has it.
    signed : largest magnitude, for a scale symmetric about zero, which is white; absent: from least to most.
    """
    displayed = values.transpose(up, across)
    scale = ONE_SIGN if signed is None else SIGNED | {"vmin": -signed, "vmax": signed}
    colours = ax.pcolormesh(
        displayed[across], displayed[up], displayed, shading="gouraud", rasterized=True, **scale
    )
    if label:
        figure.colorbar(colours, ax=ax, label=label)
    ax.grid(False)
