"""The sea, and the riser in it over time."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, ListedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from riserstudy.chapters.fem_riser.along import (
    measures,
)
from riserstudy.chapters.fem_riser.claims import (
    BEAM,
    LUMPED,
    PHASES,
    SETTLED,
    averaged,
    middle,
    reciprocates,
    settling_time,
)
from riserstudy.chapters.fem_riser.figures.shared import BLUE, DEFLECTION, HEIGHT, TIME
from riserstudy.chapters.fem_riser.figures.trends import envelopes
from riserstudy.figures.direct import label_ends
from riserstudy.figures.style import (
    COLOURS,
    PRINTED,
    headline,
    key_below,
    legend_below,
    panel_title,
    panels,
)

WINDOWS = ((0.0, 16.0), (17.0, 260.0), (261.0, 300.0))  # s
PHASE = ListedColormap(colormaps["cividis"](np.linspace(0.0, 0.85, 256)))  # of time, or the tide
LAST = ListedColormap(colormaps["Reds"](np.linspace(0.5, 0.9, 256)))  # of time, red as in the text
viridis = colormaps["viridis"]  # of heights along the riser


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
    headline(
        figure,
        "Waves move the water near the surface only",
    )
    return figure


def fig04(motion: xr.Dataset) -> Figure:
    """Deflection profiles and histories in the three windows."""
    figure, axes = panels(2, 3, 3.2)
    x, other = (motion["x"].sel(solver=solver) for solver in (BEAM, LUMPED))
    for k, (start, end) in enumerate(WINDOWS):
        window = x.sel(time=slice(start, end))
        last = other.sel(time=end, method="nearest")
        _profiles(figure, axes[k], window, last, LAST if k == 2 else PHASE)
        panel_title(axes[k], f"profiles in {start:g} to {end:g} s")
        axes[k].set_ylim(0.0, float(x["s"][-1]))
        history = axes[k + 3]
        heights = np.arange(200.0, 2000.0, 200.0)
        for colour, s in zip(viridis(np.linspace(0.0, 0.95, heights.size)), heights, strict=True):
            track = window.sel(s=s, method="nearest")
            drawn = 100.0 * (track - track.mean("time")) if k == 2 else track
            history.plot(track["time"], drawn, color=colour, linewidth=0.9, label=f"{s:g} m")
        history.set_xlabel(TIME)
        history.set_ylabel("deflection less its mean (cm)" if k == 2 else DEFLECTION)
        panel_title(history, "histories, by height")
    axes[0].set_ylabel(HEIGHT)
    dashed = Line2D([], [], label="lumped masses, last profile", **PRINTED)
    legend_below(figure, [dashed], [str(dashed.get_label())], 1)
    settled = float(settling_time(motion, SETTLED))
    headline(
        figure,
        f"The riser is steady within {100 * SETTLED:g} % after {settled:.0f} s (tide calibrated)",
    )
    label_ends(axes[4])
    return figure


def _profiles(
    figure: Figure, ax: Axes, window: xr.DataArray, last: xr.DataArray, colours: Colormap
) -> None:
    """Profiles of a window, coloured by time; dashed, the last one by the other method."""
    shapes = window.isel(time=slice(None, None, max(1, window.sizes["time"] // 24)))
    times = Normalize(float(window["time"][0]), float(window["time"][-1]))
    for time in shapes["time"].values:
        ax.plot(shapes.sel(time=time), shapes["s"], linewidth=0.7, color=colours(times(time)))
    ax.plot(last, last["s"], **PRINTED)
    figure.colorbar(ScalarMappable(times, colours), ax=ax, location="top", label=TIME, shrink=0.9)
    ax.set_xlabel(DEFLECTION)


def fig05(settled: xr.Dataset) -> Figure:
    """The base case."""
    figure = envelopes({"2000 m, ratio 1.3, factor 0.7 (assumed)": settled}, (BLUE,))
    measured = measures(settled.sel(solver=BEAM))
    place = float(measured["deflection_place"])
    ends = [
        float(measured[f"{name}_from_{end}"])
        for name in ("stress", "angle")
        for end in ("bottom", "top")
    ]
    headline(
        figure,
        f"Deflection peaks {100.0 * place:.0f} % up the riser, stress and angle within "
        f"{100.0 * max(ends):.0f} % of its ends",
    )
    return figure


def tides(tides: xr.Dataset) -> Figure:
    """Mid-length over time and the tide; how far it swings back, and when it settles."""
    figure, axes = panels(1, 3, 3.6)
    slow = averaged(middle(tides))
    values = tides["tide"].values
    for k, tide in enumerate(values):
        curve = slow.sel(tide=tide)
        axes[0].plot(curve["time"], curve / curve[-1], label=f"{tide:g} m/s",
                     color=PHASE(k / max(1, len(values) - 1)))  # fmt: skip
    printed = PHASES["second"][1]
    axes[0].axvline(printed, **PRINTED)
    axes[0].annotate(
        f"printed: {printed:g} s", (printed, 0.01), xycoords=("data", "axes fraction"), rotation=90,
        xytext=(-3, 3), textcoords="offset points", ha="right", va="bottom", fontsize="small",
    )  # fmt: skip
    axes[0].axhspan(1.0 - SETTLED, 1.0 + SETTLED, color="0.85", zorder=0)
    axes[0].set_xlabel(TIME)
    axes[0].set_ylabel("mid-length / its last mean")
    time, back = settling_time(tides, SETTLED), 100.0 * reciprocates(tides, 0.0).value
    axes[1].plot(values, back, "o-", color=BLUE)
    axes[1].set_ylabel("swing back, of the last mean (%)")
    axes[2].plot(values, time, "o-", color=BLUE)
    axes[2].axhline(printed, **PRINTED)
    axes[2].annotate(
        f"printed: {printed:g} s", (0.02, printed), xycoords=("axes fraction", "data"),
        xytext=(0, 3), textcoords="offset points", fontsize="small",
    )  # fmt: skip
    axes[2].set_ylabel("settling time (s)")
    for ax in axes[1:]:
        ax.set_xlabel("surface speed of the tide (m/s)")
        ax.set_ylim(bottom=0.0)
    nearest = float(abs(time - PHASES["second"][1]).idxmin("tide"))
    headline(
        figure,
        f"The tide sets the settling time: {float(time.sel(tide=nearest)):.0f} s at {nearest:g} m/s",
    )
    panel_title(axes[0], "by surface speed of the tide")
    key_below(figure, axes[0], 7)
    return figure
