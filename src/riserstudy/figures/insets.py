"""Enlarged parts of a panel, drawn in its empty area."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from riserstudy.figures.style import GREY

Span = tuple[float, float]


def enlarge(
    ax: Axes, place: tuple[float, float, float, float], x: Span, y: Span, widest: float = 1.2
) -> Axes:
    """Enlarge a part of a panel in its empty area; two lines connect both without crossing labels.

    It must be called after the axis limits of the panel are set.

    Parameters
    ----------
    place : left, bottom, width and height in shares of the panel.
    x, y : the part of the panel, in data coordinates; the enlarged part has the same directions.
    widest : largest line width in the enlarged part (points).

    Returns
    -------
    The enlarged part.
    """
    upside_down = bool(ax.yaxis_inverted())
    inset = ax.inset_axes(place, xlim=sorted(x), ylim=sorted(y, reverse=upside_down))
    for line in ax.lines:
        inset.add_line(_copy(line, ax, inset, widest))
    inset.tick_params(labelsize="x-small")
    inset.grid(True, color="0.9", linewidth=0.6)
    inset.set_axisbelow(True)
    frame: dict[str, Any] = {"facecolor": "none", "edgecolor": GREY, "linewidth": 0.8, "zorder": 3.0}
    ax.add_patch(Rectangle((min(x), min(y)), abs(x[1] - x[0]), abs(y[1] - y[0]), **frame))
    to_share = ax.transData + ax.transAxes.inverted()
    corners = to_share.transform([(min(x), min(y)), (max(x), max(y))])
    _lead(ax, inset, place, corners[:, 0].tolist(), sorted(corners[:, 1].tolist()))
    return inset


def name_axes(inset: Axes, x: str, y: str) -> None:
    """Write the labels of an enlarged part in small print, at the sides of its tick labels."""
    white = {"facecolor": "white", "edgecolor": "none", "pad": 0.5}  # hides lines of the panel
    above = inset.xaxis.get_ticks_position() == "top"
    inset.set_xlabel(x, fontsize="x-small", labelpad=4.0 if above else 1.0, bbox=white)
    if above:
        inset.xaxis.set_label_position("top")
    inset.set_ylabel(y, fontsize="x-small", labelpad=2.0)
    if inset.yaxis.get_ticks_position() == "right":
        inset.yaxis.set_label_position("right")


def _copy(line: Line2D, ax: Axes, inset: Axes, widest: float) -> Line2D:
    """A copy of a line of a panel in an enlarged part of it."""
    copy = Line2D(*line.get_data())
    copy.update_from(line)
    copy.set_label("_enlarged")
    copy.set_linewidth(min(widest, line.get_linewidth()))
    copy.set_clip_path(None)
    x_in_data, y_in_data = line.get_transform().contains_branch_seperately(ax.transData)
    upright, level = inset.get_xaxis_transform("grid"), inset.get_yaxis_transform("grid")
    ways = {(True, False): upright, (False, True): level}  # a line across the whole panel
    copy.set_transform(ways.get((x_in_data, y_in_data), inset.transData))
    return copy


def _lead(
    ax: Axes, inset: Axes, place: tuple[float, float, float, float], across: list[float], up: list[float]
) -> None:
    """Lines between the facing sides of a part (in shares of its panel) and the enlarged part."""
    left, bottom, width, height = place
    ends: list[tuple[Span, Span]]  # ends of both lines, at the part and at the enlarged part
    if left > across[1] or left + width < across[0]:
        after = left > across[1]
        side, facing = across[after], left if after else left + width
        levels = zip(up, (bottom, bottom + height), strict=True)
        ends = [((side, y), (facing, y_inset)) for y, y_inset in levels]
        if after:
            inset.yaxis.tick_right()
    else:
        above = bottom > up[1]
        side, facing = up[above], bottom if above else bottom + height
        places = zip(across, (left, left + width), strict=True)
        ends = [((x, side), (x_inset, facing)) for x, x_inset in places]
        if above:
            inset.xaxis.tick_top()
    for start, end in ends:
        ax.annotate(
            "", start, end, xycoords="axes fraction", textcoords="axes fraction",
            arrowprops={"arrowstyle": "-", "color": GREY, "lw": 0.6, "shrinkA": 0.0, "shrinkB": 0.0},
        )  # fmt: skip
