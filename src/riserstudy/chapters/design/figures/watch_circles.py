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
    """Where both alarms are in the middle current, and from which on there is no time for the yellow one."""
    eds, speed = (
        float(circles[name][circles.sizes[name] // 2]) for name in ("eds_time", "surface_speed")
    )
    at = circles.sel(eds_time=eds)
    red, yellow = (
        float(at[f"{name}_circle_radius"].sel(surface_speed=speed).min())
        for name in ("red", "yellow")
    )
    late = (at["yellow_circle_outcome"] == TOO_LATE).any("mud_weight").values
    more = (
        f"; from {at['surface_speed'].values[late][0]:g} m/s on it is too late"
        if late.any()
        else ""
    )
    return (
        f"Adrift in {speed:g} m/s with {eds:g} s to disconnect, the red alarm must come within {red:.0f} m "
        f"of the well, the yellow one within {yellow:.0f} m{more}"
    )
