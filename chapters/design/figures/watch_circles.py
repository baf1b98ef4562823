"""Design, watch circles: offsets of alarms over current."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from riserstudy.design.watch_circles import CIRCLE, NEVER, TOO_LATE, UNKNOWN
from riserstudy.figures.direct import label_ends, legible
from riserstudy.figures.style import GREY, headline, legend_below, panel_title, panels

RED, YELLOW = "#d62728", "#b38600"
STYLES = (":", "-", "--")
LOWEST = -5.0  # m, end of the axis: a radius of zero is seen above the frame
ROW = 8.0  # m, height of a row of crosses below zero


def watch_circles(watch_circles: xr.Dataset) -> Figure:
    """Red and yellow circle for each disconnect time, and the first limit, over current; a plan view."""
    muds = watch_circles["mud_weight"].values
    figure, every = panels((len(muds) + 2) // 2, 2, 3.4)
    axes, plan, *spare = every[: len(muds)], *every[len(muds) :]
    for ax in spare:
        ax.remove()
    lines: list[list[Line2D]] = []  # of each panel
    rows = 0  # of crosses
    for ax, mud in zip(axes, muds, strict=True):
        at = watch_circles.sel(mud_weight=mud)
        speed = at["surface_speed"]
        lines.append(ax.plot(speed, at["limit_offset"], color="black", label="first limit"))
        for colour, name in ((RED, "red"), (YELLOW, "yellow")):
            for style, eds in zip(STYLES, at["eds_time"].values, strict=False):
                one = at.sel(eds_time=eds)
                radius = one[f"{name}_circle_radius"]
                lines[-1] += ax.plot(speed, radius, style, color=colour, label=f"{name}, {eds:g} s")
        rows = max(rows, _late(ax, at))
        ax.set_xlabel("surface current speed (m/s)")
        ax.set_ylabel("platform offset at the alarm (m)")
        ax.sharey(axes[0])
        panel_title(ax, f"mud density {mud:g} kg/m³")
    axes[0].set_ylim(bottom=LOWEST - ROW * rows)
    _plan(plan, watch_circles)
    looks: tuple[tuple[str, dict[str, Any]], ...] = (
        ("red alarm, by time to disconnect", {"color": RED}),
        ("yellow alarm, by time to disconnect", {"color": YELLOW}),
        ("alarm too late even above the well", {"color": GREY, "linestyle": "", "marker": "x"}),
    )
    handles = [Line2D([], [], **look) for _, look in looks]
    legend_below(figure, handles, [label for label, _ in looks], 4)
    headline(figure, _answer(watch_circles))
    left, right = axes[0].get_xlim()
    at_edge = min(1, len(axes) - 1)
    label_ends(axes[at_edge], lines[at_edge][::-1])
    for ax in axes:
        ax.set_xlim(left, right)
    return figure


def _late(ax: Axes, circles: xr.Dataset) -> int:
    """Mark currents in which an alarm is too late, a row below zero for each alarm; return the rows."""
    rows = 0
    for colour, name in ((RED, "red"), (YELLOW, "yellow")):
        for eds in circles["eds_time"].values:
            outcome = circles[f"{name}_circle_outcome"].sel(eds_time=eds)
            speeds = circles["surface_speed"].values[(outcome == TOO_LATE).values]
            if not speeds.size:
                continue
            rows += 1
            ax.plot(speeds, np.full(speeds.size, -ROW * rows), "x", color=colour, markersize=6)
            ax.annotate(
                f"{name}, {eds:g} s", (speeds[0], -ROW * rows), xytext=(-7.0, 0.0), ha="right", va="center",
                textcoords="offset points", fontsize="small", color=legible(colour),
            )  # fmt: skip
    return rows


def _plan(ax: Axes, circles: xr.Dataset) -> None:
    """Plan view around the well for the last mud density, at the middle disconnect time and current."""
    eds, speed = (float(circles[name][circles.sizes[name] // 2]) for name in ("eds_time", "surface_speed"))
    at = circles.sel(eds_time=eds, surface_speed=speed).isel(mud_weight=-1)
    around, reach = np.linspace(0.0, 2.0 * np.pi, 181), 1.0
    for colour, quantity, name in (
        (YELLOW, "yellow_circle_radius", "yellow"),
        (RED, "red_circle_radius", "red"),
        ("black", "limit_offset", "first limit"),
    ):
        radius = float(at[quantity])
        if not np.isfinite(radius):
            continue
        reach = max(reach, radius)
        ax.plot(radius * np.cos(around), radius * np.sin(around), color=colour)
        ax.annotate(
            f"{name}: {radius:.0f} m", (0.0, radius), xytext=(0.0, 2.0), textcoords="offset points",
            ha="center", va="bottom", fontsize="small", color=legible(colour),
        )  # fmt: skip
    ax.plot(0.0, 0.0, "+", color="black", markersize=8)
    ax.set_aspect("equal")
    ax.set_xlim(-1.5 * reach, 1.5 * reach)
    ax.set_ylim(-1.15 * reach, 1.35 * reach)  # room for the last label
    ax.set_xlabel("distance along the current (m)")
    ax.set_ylabel("distance across (m)")
    panel_title(
        ax, f"view from above, {float(at['mud_weight']):g} kg/m³, {speed:g} m/s, {eds:g} s to disconnect"
    )


def _answer(circles: xr.Dataset) -> str:
    """Title: weakest current in which an alarm is too late in any mud, with the middle disconnect time.

    Without any, the smallest red circle in the strongest current, if all circles are known there.
    """
    eds = float(circles["eds_time"][circles.sizes["eds_time"] // 2])
    at = circles.sel(eds_time=eds)
    labels = []
    for name in ("yellow", "red"):
        late = (at[f"{name}_circle_outcome"] == TOO_LATE).any("mud_weight").values
        if late.any():
            since = int(late.argmax())
            where = "from" if late[since:].all() else "at"
            labels.append(f"{name} alarm is too late {where} {at['surface_speed'].values[since]:g} m/s")
    if labels:
        return f"With {eds:g} s to disconnect, the {' and the '.join(labels)}"
    strongest = at.isel(surface_speed=int(at["surface_speed"].values.argmax()))
    speed, outcomes = float(strongest["surface_speed"]), strongest["red_circle_outcome"]
    if bool((outcomes == UNKNOWN).any()):
        return f"With {eds:g} s to disconnect, the red alarm at {speed:g} m/s is not known"
    if bool((outcomes == NEVER).all()):
        return f"At {speed:g} m/s, the vessel reaches no limit within an hour"
    red = float(strongest["red_circle_radius"].where(outcomes == CIRCLE).min())
    return f"With {eds:g} s to disconnect, the red alarm is due within {red:.0f} m at {speed:g} m/s"
