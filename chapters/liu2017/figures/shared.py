"""Common parts of the figures of this chapter."""

from __future__ import annotations

from typing import Any

import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from chapters.liu2017.limits import LIMITS
from riserstudy.figures.direct import label_ends
from riserstudy.figures.style import COLOURS, GREY, PRINTED, legend_below

TIME, SURGE = "time (s)", "surge of the platform (m)"
BEGINNING = 100.0  # s
UFJ_LIMIT = 12.0  # degrees, of Table 4
HEADINGS = {"0": "0° (along)", "180": "180° (against)"}  # of the environment
#: colours of the headings; neither is a colour of a limit
OF_HEADING = {"0° (along)": "#332288", "180° (against)": "#999933"}
STROKE_OUT = "stroke-out (assumed stop)"
REFERENCE: dict[str, Any] = {"color": GREY, "linestyle": ":", "linewidth": 1.6}  # not printed
viridis = colormaps["viridis"]
plasma = colormaps["plasma"]  # contains no colour of a limit


def set_title(figure: Figure, title: str) -> None:
    """Write the title of a figure above it."""
    figure.suptitle(title, fontsize="medium")


def name_limits(figure: Figure, axes: list[Axes], *others: str) -> None:
    """Write names of limits and other lines at the right of the last panel, and a key of the rest below."""
    written = {*LIMITS, *others}
    rest = {
        label: handle
        for handle, label in zip(*axes[0].get_legend_handles_labels(), strict=True)
        if label not in written
    }
    legend_below(figure, [*rest.values()], [*rest], 4)
    label_ends(axes[-1], [line for line in axes[-1].lines if line.get_label() in written])


def mark_stroke_out(ax: Axes, place: float, value: float) -> Line2D:
    """Draw the mark that all figures use for stroke-out of the telescopic joint.

    The paper gives the limit and no stop; curves beyond the mark depend on an assumption.
    """
    label = "_" if STROKE_OUT in ax.get_legend_handles_labels()[1] else STROKE_OUT
    (mark,) = ax.plot([place], [value], "x", color="black", markersize=8, zorder=4, label=label)
    return mark


def mark_both(
    ax: Axes, out: float, conductor: float, unit: str, away: tuple[float, float] = (-5.0, 4.0)
) -> None:
    """Mark stroke-out, and the limit of the conductor soon after it, with the positions of both.

    ``away``: offset of the first position from its mark (points).
    """
    mark_stroke_out(ax, out, 1.0)
    colour = dict(zip(LIMITS, COLOURS, strict=False))["conductor"]
    ax.plot([conductor], [1.0], "o", color=colour, mec="black", mew=0.7, ms=5, zorder=5)
    for place, across, offset in ((out, "right", away), (conductor, "left", (5.0, -4.0))):
        ax.annotate(
            f"{place:.0f} {unit}", (place, 1.0), ha=across, va="bottom" if offset[1] > 0.0 else "top",
            xytext=offset, textcoords="offset points", fontsize="small",
        )  # fmt: skip


def draw_limits(ax: Axes, used: xr.DataArray) -> None:
    """Draw the used shares of limits over time, one line per limit."""
    for colour, name in zip(COLOURS, LIMITS, strict=False):
        ax.plot(used["time"], used.sel(limit=name), color=colour, label=name)
    ax.axhline(1.0, label="limit (printed)", **PRINTED)
    ax.set_xlabel(TIME)
