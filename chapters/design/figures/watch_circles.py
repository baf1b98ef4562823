"""Design, watch circles: offsets of alarms over current."""

from __future__ import annotations

from typing import Any

import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from riserstudy.design.watch_circles import TOO_LATE
from riserstudy.figures.direct import label_ends
from riserstudy.figures.style import GREY, headline, legend_below, panel_title, panels

RED, YELLOW = "#d62728", "#b38600"
STYLES = (":", "-", "--")


def watch_circles(watch_circles: xr.Dataset) -> Figure:
    """Red and yellow circle for each disconnect time, and the first limit, over current."""
    muds = watch_circles["mud_weight"].values
    figure, axes = panels(1, len(muds), 4.0, sharey=True)
    lines: list[Line2D] = []  # in the last panel
    for ax, mud in zip(axes, muds, strict=True):
        at = watch_circles.sel(mud_weight=mud)
        speed = at["surface_speed"]
        lines = ax.plot(speed, at["limit_offset"], color="black", label="first limit")
        for colour, name in ((RED, "red"), (YELLOW, "yellow")):
            for style, eds in zip(STYLES, at["eds_time"].values, strict=False):
                one = at.sel(eds_time=eds)
                radius = one[f"{name}_circle_radius"]
                lines += ax.plot(speed, radius, style, color=colour, label=f"{name}, {eds:g} s")
                late = one[f"{name}_circle_outcome"] == TOO_LATE
                if bool(late.any()):
                    ax.plot(speed, radius.where(late), "x", color=colour, markersize=6, clip_on=False)
        ax.set_xlabel("surface current speed (m/s)")
        ax.set_ylim(bottom=-5.0)  # a radius of zero is seen above the frame
        panel_title(ax, f"mud density {mud:g} kg/m³")
    axes[0].set_ylabel("offset at which the alarm is due (m)")
    looks: tuple[tuple[str, dict[str, Any]], ...] = (
        ("red alarm, by time to disconnect", {"color": RED}),
        ("yellow alarm, by time to disconnect", {"color": YELLOW}),
        ("too late even above the well", {"color": GREY, "linestyle": "", "marker": "x"}),
    )
    handles = [Line2D([], [], **look) for _, look in looks]
    legend_below(figure, handles, [label for label, _ in looks], 4)
    headline(figure, _answer(watch_circles))
    left, right = axes[0].get_xlim()
    label_ends(axes[-1], lines[::-1])
    for ax in axes:
        ax.set_xlim(left, right)
    return figure


def _answer(circles: xr.Dataset) -> str:
    """Title: weakest current in which an alarm is too late in any mud, with the middle disconnect time."""
    eds = float(circles["eds_time"][circles.sizes["eds_time"] // 2])
    at = circles.sel(eds_time=eds)
    labels = []
    for name in ("yellow", "red"):
        late = (at[f"{name}_circle_outcome"] == TOO_LATE).any("mud_weight").values
        if late.any():
            labels.append(f"{name} alarm is too late from {at['surface_speed'].values[late][0]:g} m/s")
    if labels:
        return f"With {eds:g} s to disconnect, the {' and the '.join(labels)}"
    speed = float(at["surface_speed"].max())
    red = float(at["red_circle_radius"].sel(surface_speed=speed).min())
    return f"With {eds:g} s to disconnect, the red alarm is due within {red:.0f} m at {speed:g} m/s"
