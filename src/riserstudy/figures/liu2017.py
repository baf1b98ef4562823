"""Figures of Liu et al. 2017: the printed ones by number, others by what they show.

Axis ranges are not printed: the first 100 s are shown, up to the largest surge of about 150 m.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, GREY, PRINTED, key_below, panels

SETS = {"ref": "unlimited thrust", "sat": "thrust limited to 4.5 MN"}
HEADINGS = {"0": "0° (along)", "180": "180° (against)"}
TIME, SURGE = "time (s)", "surge of the platform (m)"
SHOWN = 100.0  # s
DEADLINE, UFJ_LIMIT = 50.0, 12.0  # s and degrees; config/published/liu2017.yaml, N1
FORCE_AT_LIMIT = -3.02 * np.sin(np.deg2rad(UFJ_LIMIT))  # MN, which Fig 6 implies


def fig04(driveoff: xr.Dataset) -> Figure:
    """Surge and speed over time, with and without riser, for both sets of inputs."""
    figure, axes = panels(2, 2, 3.2, sharex=True)
    shown = driveoff.sel(time=slice(0.0, SHOWN))
    for column, (kind, title) in enumerate(SETS.items()):
        for colour, (heading, label) in zip(COLOURS, HEADINGS.items(), strict=False):
            for ending, line, word in (("", "-", "with"), ("_no_riser", "--", "without")):
                run = shown.sel(case=f"{kind}_{heading}{ending}")
                text = f"{label}, {word} riser"
                axes[column].plot(
                    run["time"], run["platform_surge"], line, color=colour, label=text
                )
                axes[2 + column].plot(run["time"], run["platform_speed_x"], line, color=colour)
        axes[column].axhline(100.0, color=GREY, linewidth=0.9)
        axes[column].set_title(title, loc="right", fontsize="small")
        axes[2 + column].set_xlabel(TIME)
    axes[0].set_ylabel(SURGE)
    axes[2].set_ylabel("speed of the platform (m/s)")
    key_below(figure, axes[0], 4)
    return figure


def fig06(driveoff: xr.Dataset) -> Figure:
    """Force of the riser on the platform."""
    figure, axes = panels(1, 2, 3.6, sharey=True)
    shown = driveoff.sel(time=slice(0.0, SHOWN))
    for ax, (kind, title) in zip(axes, SETS.items(), strict=True):
        for colour, (heading, label) in zip(COLOURS, HEADINGS.items(), strict=False):
            run = shown.sel(case=f"{kind}_{heading}")
            printed, exact = run["riser_force_x"] / 1e6, run["riser_reaction_x"] / 1e6
            ax.plot(run["time"], printed, color=colour, label=f"{label}, T sin θ as printed")
            ax.plot(run["time"], exact, ":", color=colour, label=f"{label}, exact reaction")
        ax.axhline(FORCE_AT_LIMIT, label="T sin 12°", **PRINTED)
        ax.set_xlabel(TIME)
        ax.set_title(title, loc="right", fontsize="small")
    axes[0].set_ylabel("force of the riser on the platform (MN)")
    key_below(figure, axes[0], 3)
    return figure
