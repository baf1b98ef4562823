"""Names of lines next to the lines, instead of a key."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

DARKEST_LIGHT = 0.35  # largest luminance of a colour that is legible as text on white
APART = 1.1  # smallest distance of two texts, in text heights
POINTS_AN_INCH = 72.0


def label_ends(
    ax: Axes,
    lines: Sequence[Line2D] | None = None,
    *,
    names: Sequence[str] | None = None,
    size: str = "small",
) -> None:
    """Write the names of lines at the right edge of a panel, where the lines end, without overlap.

    It must be called last, after axis limits and other texts are set.

    Parameters
    ----------
    lines : lines to name; absent: all lines of the panel that have a name.
    names : their names; absent: the names of the lines.
    size : size of the text.
    """
    figure = ax.get_figure(root=True)
    if figure is None:
        raise ValueError("the panel belongs to no figure")
    ax.margins(x=0.0)
    figure.draw_without_rendering()  # computes the layout of the panels
    points = FontProperties(size=size).get_size_in_points()
    apart = APART * points / POINTS_AN_INCH * figure.dpi / ax.bbox.height
    chosen = named(ax) if lines is None else list(lines)
    to_share = ax.transData + ax.transAxes.inverted()
    ends = np.array([to_share.transform(_end(ax, line))[1] for line in chosen])
    texts = [str(line.get_label()) for line in chosen] if names is None else names
    heights = apart * np.array([1.0 + text.count("\n") for text in texts])
    for line, text, place in zip(chosen, texts, spread(ends, heights), strict=True):
        ax.annotate(
            text, (1.0, float(place)), xycoords="axes fraction",
            xytext=(4.0, 0.0), textcoords="offset points", va="center", fontsize=size,
            color=legible(line.get_color()), annotation_clip=False,
        )  # fmt: skip


def label_line(
    ax: Axes,
    line: Line2D,
    share: float,
    offset: tuple[float, float] = (4.0, 0.0),
    *,
    name: str | None = None,
    size: str = "small",
    **alignment: Any,
) -> None:
    """Write a name next to a line at one of its points.

    Parameters
    ----------
    share : share of the line's points before this point, 0 to 1.
    offset : offset of the text from this point (points).
    name : absent: the name of the line.
    alignment : ``ha`` and ``va`` of the text; absent: from the offset.
    """
    x, y = (np.asarray(values, dtype=float) for values in line.get_data())
    k = round(share * (len(x) - 1))
    across = "left" if offset[0] > 0.0 else "right" if offset[0] < 0.0 else "center"
    up = "bottom" if offset[1] > 0.0 else "top" if offset[1] < 0.0 else "center"
    ax.annotate(
        str(line.get_label()) if name is None else name, (float(x[k]), float(y[k])),
        xytext=offset, textcoords="offset points", fontsize=size, color=legible(line.get_color()),
        annotation_clip=False, path_effects=[withStroke(linewidth=2.0, foreground="white")],
        **({"ha": across, "va": up} | alignment),
    )  # fmt: skip


def named(ax: Axes) -> list[Line2D]:
    """Lines of a panel that have a name."""
    return [line for line in ax.lines if not str(line.get_label()).startswith("_")]


def legible(colour: Any) -> tuple[float, float, float]:
    """A colour, darkened if it is too light for text on white."""
    red, green, blue = to_rgb(colour)
    light = 0.2126 * red + 0.7152 * green + 0.0722 * blue
    share = min(1.0, DARKEST_LIGHT / light) if light else 1.0
    return red * share, green * share, blue * share


def spread(places: NDArray[np.float64], heights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Middles of texts, moved by the least squares until none overlap; the order is kept.

    Parameters
    ----------
    places : (n,) wanted middles.
    heights : (n,) heights of the texts, in the same unit.
    """
    order = np.argsort(places, kind="stable")
    tall = heights[order]
    # least distance to the first
    below = np.concatenate([[0.0], np.cumsum(0.5 * (tall[1:] + tall[:-1]))])
    pools: list[list[float]] = []  # mean and size of neighbours that move together
    for place, least in zip(places[order], below, strict=True):
        pools.append([float(place - least), 1.0])
        while len(pools) > 1 and pools[-2][0] > pools[-1][0]:
            mean, size = pools.pop()
            before, many = pools[-1]
            pools[-1] = [(before * many + mean * size) / (many + size), many + size]
    levels = np.repeat([mean for mean, _ in pools], [int(size) for _, size in pools])
    moved = np.empty_like(places)
    moved[order] = levels + below
    return moved


def _end(ax: Axes, line: Line2D) -> tuple[float, float]:
    """Point at which a line ends, or leaves its panel at the side."""
    x, y = (np.asarray(values, dtype=float) for values in line.get_data())
    finite = np.isfinite(x) & np.isfinite(y)
    order = np.argsort(x[finite], kind="stable")
    x, y = x[finite][order], y[finite][order]
    low, high = sorted(ax.get_xlim())
    edge = min(max(float(x[-1]), low), high)
    return edge, float(np.interp(edge, x, y))
