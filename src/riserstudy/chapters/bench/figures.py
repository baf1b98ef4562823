"""Figures of the bench scenes, which other simulators can run too."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, panels

STATIONS = (433.0, 333.0, 233.0, 133.0)  # m from the bottom


def statics(s1: xr.Dataset, s4b: xr.Dataset, s4c: xr.Dataset, s4e: xr.Dataset) -> Figure:
    """Shapes in x and z."""
    figure, axes = panels(2, 2)
    named = (
        ("S1, current", s1),
        ("S4b, line load", s4b),
        ("S4c, tip load", s4c),
        ("S4e, cable", s4e),
    )
    for ax, colour, (label, scene) in zip(axes, COLOURS, named, strict=False):
        ax.plot(scene["x"], scene["z"], color=colour, label=label)
        ax.set_xlabel("lateral position x (m)")
        ax.set_ylabel("elevation z (m)")
        ax.legend(fontsize="small")
    for ax in axes[2:]:
        ax.set_aspect("equal", adjustable="datalim")
    return figure


def surge(s2: xr.Dataset, s2c: xr.Dataset) -> Figure:
    """Histories, moment envelopes, top tension."""
    figure, axes = panels(1, 3)
    for colour, s in zip(COLOURS, STATIONS, strict=False):
        history = s2["x"].interp(s=s, method="cubic")
        axes[0].plot(history["time"], history, color=colour, linewidth=0.8, label=f"s = {s:.0f} m")
    axes[0].set_xlabel("time (s)")
    axes[0].set_ylabel("lateral position x (m), S2")
    axes[0].legend(fontsize="small", ncols=2, loc="lower left")
    for colour, (name, scene) in zip(COLOURS, (("S2", s2), ("S2c", s2c)), strict=False):
        for side in ("max", "min"):
            moment = scene[f"bending_moment_{side}"] / 1e3
            axes[1].plot(
                moment, scene["s_node"], color=colour, label=name if side == "max" else None
            )
        tension = scene["effective_tension"].isel(s=-1) / 1e3
        axes[2].plot(tension["time"], tension, color=colour, linewidth=0.8, label=name)
    axes[1].set_xlabel("bending moment envelope (kN m)")
    axes[1].set_ylabel("s (m)")
    axes[2].set_xlabel("time (s)")
    axes[2].set_ylabel("top tension (kN)")
    axes[2].set_ylim(bottom=2100)
    axes[1].legend(fontsize="small")
    axes[2].legend(fontsize="small", loc="lower right")
    return figure


def heave(s3: xr.Dataset) -> Figure:
    """Top tension and motion of the lower end."""
    figure, axes = panels(1, 2)
    axes[0].plot(s3["time"], s3["effective_tension"].isel(s=-1) / 1e6, color=COLOURS[0])
    axes[0].set_ylabel("top tension (MN)")
    moved = s3["z"] - s3["z_static"].values
    axes[1].plot(s3["time"], moved.isel(s=-1), color=COLOURS[1], label="top")
    axes[1].plot(s3["time"], moved.isel(s=0), color=COLOURS[0], label="lower end")
    axes[1].set_ylabel("elevation above rest (m)")
    axes[1].legend(fontsize="small")
    for ax in axes:
        ax.set_xlabel("time (s)")
    return figure
