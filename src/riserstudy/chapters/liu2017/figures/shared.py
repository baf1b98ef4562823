"""What figures of this chapter have in common."""

from __future__ import annotations

import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.chapters.liu2017.limits import LIMITS
from riserstudy.figures.direct import label_ends
from riserstudy.figures.style import COLOURS, PRINTED, legend_below

TIME, SURGE = "time (s)", "surge of the platform (m)"
SHOWN = 100.0  # s
UFJ_LIMIT = 12.0  # degrees, of Table 4
viridis = colormaps["viridis"]
plasma = colormaps["plasma"]  # where limits have colours, of which it has none


def set_title(figure: Figure, title: str) -> None:
    """What a figure shows, above it."""
    figure.suptitle(title, fontsize="medium")


def name_limits(figure: Figure, axes: list[Axes], *others: str) -> None:
    """Names of limits, and of other lines, at the right ends of the last panel; a key of the rest below."""
    written = {*LIMITS, *others}
    rest = {
        label: handle
        for handle, label in zip(*axes[0].get_legend_handles_labels(), strict=True)
        if label not in written
    }
    legend_below(figure, [*rest.values()], [*rest], 4)
    label_ends(axes[-1], [line for line in axes[-1].lines if line.get_label() in written])


def mark_both(ax: Axes, first: float, second: float, unit: str) -> None:
    """Mark where two limits are reached one soon after the other, with both places."""
    for place, across, up in ((first, "right", "bottom"), (second, "left", "top")):
        ax.plot([place], [1.0], "o", color="black", ms=4, zorder=3)
        ax.annotate(
            f"{place:.0f} {unit}", (place, 1.0), ha=across, va=up, fontsize="small",
            xytext=(-5.0 if across == "right" else 5.0, 4.0 if up == "bottom" else -4.0),
            textcoords="offset points",
        )  # fmt: skip


def draw_limits(ax: Axes, used: xr.DataArray) -> None:
    """Shares of limits that are used over time (-), a line a limit."""
    for colour, name in zip(COLOURS, LIMITS, strict=False):
        ax.plot(used["time"], used.sel(limit=name), color=colour, label=name)
    ax.axhline(1.0, label="limit (printed)", **PRINTED)
    ax.set_xlabel(TIME)
