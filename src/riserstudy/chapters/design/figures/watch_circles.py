"""Design, watch circles: offsets of alarms over current."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from riserstudy.design.watch_circles import TOO_LATE
from riserstudy.figures.style import headline, key_below, panels

RED, YELLOW = "#d62728", "#e0b000"
STYLES = (":", "-", "--")


def watch_circles(watch_circles: xr.Dataset) -> Figure:
    """Red and yellow circle by the time that a disconnect takes, and the first limit."""
    muds = watch_circles["mud_weight"].values
    figure, axes = panels(1, len(muds), 4.0, sharey=True)
    for ax, mud in zip(axes, muds, strict=True):
        at = watch_circles.sel(mud_weight=mud)
        speed = at["surface_speed"]
        ax.plot(speed, at["limit_offset"], color="black", label="first limit")
        for colour, name in ((RED, "red"), (YELLOW, "yellow")):
            for style, eds in zip(STYLES, at["eds_time"].values, strict=False):
                radius = at[f"{name}_circle_radius"].sel(eds_time=eds)
                label = f"{name}, disconnect takes {eds:g} s"
                ax.plot(speed, radius, style, color=colour, label=label)
        ax.set_xlabel("current at the surface (m/s)")
        ax.set_ylim(bottom=0.0)
        ax.set_title(f"mud of {mud:g} kg/m³", loc="right", fontsize="small")
    axes[0].set_ylabel("offset of the alarm (m)")
    key_below(figure, axes[0], 4)
    headline(figure, _answer(watch_circles))
    return figure


def _answer(circles: xr.Dataset) -> str:
    """Up to which current there is time for both alarms, and where they are then."""
    eds = float(circles["eds_time"][len(circles["eds_time"]) // 2])
    at = circles.sel(eds_time=eds)
    in_time = (at["yellow_circle_outcome"] != TOO_LATE).all("mud_weight").values
    takes = f"a disconnect of {eds:g} s"
    if not in_time.any():
        return f"Adrift in any current of the chart the yellow alarm of {takes} is too late"
    speed = float(at["surface_speed"].values[in_time][-1])
    red, yellow = (
        float(at[f"{name}_circle_radius"].sel(surface_speed=speed).min())
        for name in ("red", "yellow")
    )
    more = (
        "" if in_time.all() else "; in stronger ones even a yellow alarm at the start is too late"
    )
    return (
        f"Adrift in {speed:g} m/s, {takes} leaves time with the yellow alarm within {yellow:.0f} m of the "
        f"well and the red one within {red:.0f} m{more}"
    )
