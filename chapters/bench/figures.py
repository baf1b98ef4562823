"""Figures of the bench scenes, which other simulators can run too."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from scipy.interpolate import PchipInterpolator

from riserstudy.figures.direct import label_ends
from riserstudy.figures.style import COLOURS, headline, legend_below, panel_title, panels, shades

STATIONS = (433.0, 333.0, 233.0, 133.0)  # m from the bottom
SAME = 1.02  # ratio up to which two largest moments hardly differ
FINE = 500  # points of a curve through the values at the nodes
LAST = 40.0  # s, plotted time at the end of the histories


def statics(s1: xr.Dataset, s4b: xr.Dataset, s4c: xr.Dataset, s4e: xr.Dataset) -> Figure:
    """Static shapes in x and z."""
    figure, axes = panels(2, 2)
    named = (
        ("riser in a current (S1), x stretched", s1),
        ("riser under a line load (S4b), x stretched", s4b),
        ("cantilever under a tip load (S4c), true to scale", s4c),
        ("hanging cable (S4e), true to scale", s4e),
    )
    for ax, (title, scene) in zip(axes, named, strict=True):
        ax.plot(scene["x"], scene["z"], color=COLOURS[0])
        ax.set_xlabel("lateral position x (m)")
        ax.set_ylabel("elevation z (m)")
        panel_title(ax, title)
    for ax, (_, scene) in zip(axes[:2], named[:2], strict=True):
        k = int(np.abs(scene["x"].values).argmax())
        place = float(scene["x"][k]), float(scene["z"][k])
        ax.annotate(
            f"{abs(place[0]):.2g} m", place, (-6, 0), textcoords="offset points", ha="right", va="center"
        )
    for ax in axes[2:]:
        ax.set_aspect("equal", adjustable="datalim")
    headline(figure, "Static shapes of a riser, a cantilever and a cable under load")
    return figure


def surge(s2: xr.Dataset, s2c: xr.Dataset) -> Figure:
    """Histories of lateral position, moment envelopes, and top tension."""
    figure, axes = panels(1, 3)
    named = (("S2, constant top tension", s2), ("S2c, top held at its height", s2c))
    lines = []
    for colour, s in zip(shades(COLOURS[0], len(STATIONS))[::-1], STATIONS, strict=True):
        history = s2["x"].interp(s=s, method="cubic")
        lines += axes[0].plot(history["time"], history, color=colour, linewidth=1.2, label=f"{s:.0f} m")
    axes[0].set_xlabel("time (s)")
    axes[0].set_ylabel("lateral position x (m)")
    panel_title(axes[0], "S2, by distance from the bottom")
    axes[0].set_xlim(float(s2["time"][-1]) - LAST, float(s2["time"][-1]))
    for colour, (name, scene) in zip(COLOURS, named, strict=False):
        heights = np.linspace(float(scene["s_node"][0]), float(scene["s_node"][-1]), FINE)
        for side in ("max", "min"):
            moment = PchipInterpolator(scene["s_node"], scene[f"bending_moment_{side}"] / 1e3)(heights)
            axes[1].plot(moment, heights, color=colour, linewidth=1.3, label=name if side == "max" else None)
        tension = scene["effective_tension"].isel(s=-1) / 1e3
        axes[2].plot(tension["time"], tension, color=colour, linewidth=0.9, label=name)
    axes[1].set_xlabel("bending moment envelope (kN m)")
    axes[1].set_ylabel("distance from the bottom (m)")
    largest = [_largest_moment(scene) for _, scene in named]
    words = dict.fromkeys(f"{one:.0f}" for one in largest)
    both = " in both" if len(words) == 1 else ""
    panel_title(axes[1], f"largest moment {' and '.join(words)} kN m{both}")
    axes[2].set_xlabel("time (s)")
    axes[2].set_ylabel("top tension (kN)")
    late = s2c["effective_tension"].isel(s=-1).sel(time=slice(float(s2c["time"][-1]) - LAST, None)) / 1e3
    varied = 0.5 * float(late.max() - late.min())
    panel_title(axes[2], f"amplitude in S2c: {float(f'{varied:.2g}'):.0f} kN")
    legend_below(figure, *axes[1].get_legend_handles_labels(), 2)
    headline(
        figure,
        "Holding the top's height changes the tension, but hardly the largest moment"
        if max(largest) < SAME * min(largest)
        else "Surge with constant top tension, and with the top held at its height",
    )
    label_ends(axes[0], lines)
    return figure


def _largest_moment(scene: xr.Dataset) -> float:
    """Largest magnitude of the bending moment (kN m)."""
    return max(float(abs(scene[f"bending_moment_{side}"]).max()) for side in ("max", "min")) / 1e3


def heave(s3: xr.Dataset) -> Figure:
    """Top tension, and motion of the lower end relative to the top."""
    figure, axes = panels(1, 2)
    axes[0].plot(s3["time"], s3["effective_tension"].isel(s=-1) / 1e6, color=COLOURS[0])
    axes[0].set_ylabel("top tension (MN)")
    moved = s3["z"] - s3["z_static"].values
    stretch = moved.isel(s=0) - moved.isel(s=-1)
    axes[1].plot(s3["time"], 1e3 * stretch, color=COLOURS[0])
    axes[1].set_ylabel("lower-end motion\nminus top motion (mm)")
    late = slice(float(s3["time"][-1]) - LAST, None)
    most = 1e3 * float(-stretch.sel(time=late).min())
    heaved = float(abs(moved.isel(s=-1)).max())
    panel_title(axes[0], "top tension")
    panel_title(axes[1], "change of length; below 0 the riser is longer")
    for ax in axes:
        ax.set_xlabel("time (s)")
        ax.margins(x=0.0)
    axes[1].axhline(-most, color="black", linewidth=0.8, linestyle="--")
    axes[1].margins(y=0.1)
    axes[1].annotate(
        f"{most:.0f} mm longer", (1.0, -most), xycoords=("axes fraction", "data"), xytext=(-3, -3),
        textcoords="offset points", ha="right", va="top", fontsize="small",
    )  # fmt: skip
    headline(figure, f"Heave of ±{heaved:.2g} m stretches the riser by {most:.0f} mm in steady state")
    return figure
