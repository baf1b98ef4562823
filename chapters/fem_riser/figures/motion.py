"""Water motion under the wave, and motion of the riser over time."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, ListedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from chapters.fem_riser.along import measures
from chapters.fem_riser.claims import (
    BEAM,
    LUMPED,
    PHASES,
    SETTLED,
    averaged,
    fades_with_depth,
    middle,
    reciprocates,
    settling_time,
)
from chapters.fem_riser.figures.shared import BLUE, DEFLECTION, HEIGHT, TIME
from chapters.fem_riser.figures.trends import envelopes
from riserstudy.figures.direct import label_ends
from riserstudy.figures.insets import enlarge, name_axes
from riserstudy.figures.style import (
    COLOURS,
    GREY,
    PRINTED,
    headline,
    key_below,
    legend_below,
    panel_title,
    panels,
)

LATE = (200.0, 1000.0, 1800.0)  # m, heights of the last window
ENLARGED = 1950.0  # m, height of the enlarged part of the last profiles
FADED, NEAR_SURFACE = 0.05, 0.1  # shares of the surface value and of the water depth, as in claim B1
NEAR = 0.03  # relative difference from the printed time that a title calls nearly
WINDOWS = ((0.0, 16.0), (17.0, 260.0), (261.0, 300.0))  # s
PHASE = ListedColormap(colormaps["cividis"](np.linspace(0.0, 0.85, 256)))  # of time
LAST = ListedColormap(colormaps["Reds"](np.linspace(0.5, 0.9, 256)))  # of time, red as in the text
#: circles for the other method; the line of the paper's method is visible between them
OTHER: dict[str, Any] = {
    "color": "black", "marker": "o", "markersize": 4, "markerfacecolor": "none", "linestyle": "none",
}  # fmt: skip
MEAN: dict[str, Any] = {"color": "0.6", "linewidth": 5.0, "zorder": 1.0}
GREENS = ListedColormap(colormaps["Greens"](np.linspace(0.35, 1.0, 256)))  # of heights along the riser
plasma = colormaps["plasma"]  # of tides


def fig03(water: xr.Dataset) -> Figure:
    """Velocity and acceleration under the wave, and current."""
    figure, axes = panels(1, 3, 3.8)
    near = water.sel(below_surface=slice(0.0, 60.0))
    for ax, name, label in zip(
        axes,
        ("wave_velocity", "wave_acceleration"),
        ("wave velocity (m/s)", "wave acceleration (m/s²)"),
        strict=False,
    ):
        drawn = ax.pcolormesh(
            near["time"],
            near["below_surface"],
            near[name].T,
            cmap="RdBu_r",
            shading="gouraud",
            rasterized=True,
        )
        figure.colorbar(drawn, ax=ax, label=label, location="top", shrink=0.9)
        ax.invert_yaxis()
        ax.set_xlabel(TIME)
        panel_title(ax, "upper 60 m")
    axes[2].plot(water["water_speed"], water["below_surface"], color=COLOURS[0])
    axes[2].set_xlabel("speed of the current (m/s)")
    panel_title(axes[2], "whole riser; current assumed")
    for ax in axes:
        ax.set_ylabel("depth (m)")
    axes[2].set_ylim(float(water["below_surface"][-1]), 0.0)
    axes[2].set_xlim(left=0.0)
    deepest = float(fades_with_depth(water, FADED, NEAR_SURFACE).value)
    headline(figure, _reach_of_waves(deepest, float(water["below_surface"].max())))
    return figure


def _reach_of_waves(share: float, depth: float) -> str:
    """Title: whether the wave motion is confined to the surface; ``share`` of the water depth (m)."""
    if share <= NEAR_SURFACE:
        return "Waves move the water near the surface only"
    deep = f"Waves move the water down to {share * depth:.0f} m"
    return deep if share < 1.0 else "Waves move the water down to the seabed"


def fig04(motion: xr.Dataset) -> Figure:
    """Deflection profiles and histories in the three windows."""
    figure, axes = panels(2, 3, 3.2)
    x, other = (motion["x"].sel(solver=solver) for solver in (BEAM, LUMPED))
    for k, (start, end) in enumerate(WINDOWS):
        window = x.sel(time=slice(start, end))
        last = other.sel(time=end, method="nearest")
        if k == 2:
            _mean(axes[5], motion)
        _profiles(figure, axes[k], window, last, LAST if k == 2 else PHASE)
        panel_title(axes[k], f"profiles in {start:g} to {end:g} s")
        axes[k].set_ylim(0.0, float(x["s"][-1]))
        _histories(axes[k + 3], window, last_window=k == 2)
    _enlarge_last(axes[2], x.sel(time=slice(*WINDOWS[2])))
    for ax, title in zip(axes[3:], ("heights as in (e)", "heights s", "minus the last mean"), strict=True):
        panel_title(ax, f"histories, {title}")
    axes[0].set_ylabel(HEIGHT)
    height = float(x["s"][x.sizes["s"] // 2])
    settled = float(settling_time(motion, SETTLED))
    key = {
        "(a–c) lumped masses, last profile": Line2D([], [], **OTHER),
        f"(f) mean over a wave at mid-length, {height:g} m": Line2D([], [], **MEAN),
        f"(f) {100 * SETTLED:g} % around the last value of the mean": Patch(color="0.92"),
    }
    legend_below(figure, [*key.values()], [*key], 3)
    headline(figure, f"With the calibrated tide, the mid-length deflection is steady after {settled:.0f} s")
    for ax in axes[4:]:
        label_ends(ax, size="x-small")
    axes[3].margins(x=0.0)
    return figure


def _enlarge_last(ax: Axes, x: xr.DataArray) -> None:
    """Enlarge the profiles of the last window around a height at which the wave moves the riser."""
    at = x.sel(s=ENLARGED, method="nearest")
    low, high, s = float(at.min()), float(at.max()), float(at["s"])
    room = 0.8 * (high - low)
    up = 2.0 * room * (float(x["s"][-1]) - s) / high  # as high as the lines' slope requires
    inset = enlarge(ax, (0.17, 0.31, 0.33, 0.37), (low - room, high + room), (s - up, s + up), widest=0.7)
    inset.locator_params(axis="x", nbins=2)
    name_axes(inset, "x (m)", "s (m)")


def _mean(ax: Axes, motion: xr.Dataset) -> None:
    """Mean over a wave at mid-length, minus its last value (cm), behind the lines of single heights."""
    slow = 100.0 * averaged(middle(motion))
    final = float(slow.isel(time=-1))
    slow = slow.sel(time=slice(WINDOWS[2][0], None)) - final
    ax.plot(slow["time"], slow, **MEAN)
    ax.axhspan(-SETTLED * abs(final), SETTLED * abs(final), color="0.92", zorder=0)


def _histories(ax: Axes, window: xr.DataArray, *, last_window: bool) -> None:
    """Deflection over time every 200 m; in the last window at some heights, minus their last means."""
    heights = np.arange(200.0, 2000.0, 200.0)
    shades = GREENS(np.linspace(0.0, 1.0, heights.size))
    for colour, s in zip(shades, heights, strict=True):
        if last_window and s not in LATE:
            continue
        track = window.sel(s=s, method="nearest")
        drawn = 100.0 * (track - averaged(track).isel(time=-1)) if last_window else track
        ax.plot(track["time"], drawn, color=colour, linewidth=0.9, label=f"{s:g} m")
    ax.set_xlabel(TIME)
    ax.set_ylabel("deviation (cm)" if last_window else DEFLECTION)
    ax.margins(y=0.1)  # room for labels


def _profiles(figure: Figure, ax: Axes, window: xr.DataArray, last: xr.DataArray, colours: Colormap) -> None:
    """Profiles of a window, coloured by time; circles: last profile by the other method."""
    shapes = window.isel(time=slice(None, None, max(1, window.sizes["time"] // 24)))
    times = Normalize(float(window["time"][0]), float(window["time"][-1]))
    for time in shapes["time"].values:
        ax.plot(shapes.sel(time=time), shapes["s"], linewidth=0.7, color=colours(times(time)))
    ax.plot(last, last["s"], markevery=max(1, last.sizes["s"] // 20), **OTHER)
    figure.colorbar(ScalarMappable(times, colours), ax=ax, location="top", label=TIME, shrink=0.9)
    ax.set_xlabel(DEFLECTION)


def fig05(settled: xr.Dataset) -> Figure:
    """Envelopes of the base case."""
    figure = envelopes({"2000 m, tension ratio 1.3, buoyant factor 0.7 (assumed)": settled}, (BLUE,))
    measured = measures(settled.sel(solver=BEAM))
    place = float(measured["deflection_place"])
    ends = [float(measured[f"{of}_from_{end}"]) for of in ("stress", "angle") for end in ("bottom", "top")]
    near = math.ceil(100.0 * max(ends) - 1e-9)
    headline(
        figure,
        f"Deflection peaks {100.0 * place:.0f} % up the riser, stress and angle within {near} % of its ends",
    )
    return figure


def tides(tides: xr.Dataset) -> Figure:
    """Mid-length deflection over time by tide; its reversal, and the time at which it is steady."""
    figure, axes = panels(1, 3, 3.6)
    slow = averaged(middle(tides))
    values = tides["tide"].values
    shades = plasma(np.linspace(0.0, 0.9, len(values)))
    for k, tide in enumerate(values):
        curve = slow.sel(tide=tide)
        axes[0].plot(curve["time"], curve / curve[-1], color=shades[k], label=f"_tide {tide:g} m/s")
    printed = PHASES["second"][1]
    axes[0].axvline(printed, **PRINTED)
    axes[0].annotate(
        f"printed: {printed:g} s", (printed, 0.01), xycoords=("data", "axes fraction"), rotation=90,
        xytext=(-3, 3), textcoords="offset points", ha="right", va="bottom", fontsize="small",
    )  # fmt: skip
    axes[0].axhspan(1.0 - SETTLED, 1.0 + SETTLED, color="0.8", label=f"steady: within {100 * SETTLED:g} %")
    axes[0].set_xlabel(TIME)
    axes[0].set_ylabel("ratio of the deflection to its last mean")
    time, back = settling_time(tides, SETTLED), 100.0 * reciprocates(tides, 0.0).value
    axes[1].set_ylabel("decrease / last mean deflection (%)")
    for ax, title in zip(
        axes,
        ("deflection, colours as in (b, c)", "decrease after the maximum", "time to steady state"),
        strict=True,
    ):
        panel_title(ax, title)
    for ax, found in ((axes[1], back), (axes[2], time)):
        ax.plot(values, found, "-", color=GREY, linewidth=0.9)
        for colour, tide, value in zip(shades, values, found.values, strict=True):
            ax.plot(tide, value, "o", color=colour, markersize=7)
    axes[2].axhline(printed, **PRINTED)
    axes[2].annotate(
        f"printed: {printed:g} s", (0.02, printed), xycoords=("axes fraction", "data"),
        xytext=(0, 3), textcoords="offset points", fontsize="small",
    )  # fmt: skip
    axes[2].set_ylabel("time to steady state (s)")
    for ax in axes[1:]:
        ax.set_xlabel("tide speed (m/s)")
        ax.set_ylim(bottom=-0.04 * ax.get_ylim()[1])  # room for whole marks at zero
        ax.set_xlim(-0.06 * values.max(), 1.06 * values.max())
    near = values[abs(time.values / printed - 1.0) < NEAR]
    headline(
        figure,
        f"Tides of {near[0]:g} and {near[-1]:g} m/s give nearly the printed time to steady state"
        if len(near) == 2
        else "The tide determines the time to steady state",
    )
    key_below(figure, axes[0], 4)
    return figure
