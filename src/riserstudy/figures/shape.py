"""Side view of the riser in one run: at rest, in motion, and at its largest displacements to both sides."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.dataset.unit_systems import read_in
from riserstudy.errors import InputError
from riserstudy.figures.grid import evenly_spaced, key, label, read
from riserstudy.figures.style import COLOURS, GREY, headline, panels

SNAPSHOTS = 24
SIDES = "largest", "smallest"


def shape(run: xr.Dataset, title: str) -> Figure:
    """Elevation over position, with a panel for each horizontal direction of the run.

    Raises InputError when there are no lateral positions: they were not kept, or the riser has only axial
    motion.
    """
    names = [name for name in "xy" if {name, f"{name}_static"} & set(run)]
    if not names:
        found = "lateral positions are missing: they were not stored, or the motion is axial only"
        raise InputError(title, "x", found, "keep x and x_static, or choose the figure range or time-series")
    if not {"z", "z_static"} & set(run):
        found = "elevations are missing, since they were not stored"
        allowed = "keep z, or choose the figure range or time-series"
        raise InputError(title, "z", found, allowed)
    figure, axes = panels(1, len(names), 5.0, sharey=True)
    for ax, name in zip(axes, names, strict=True):
        _panel(ax, run, name)
        ax.set_xlabel(label(_named(run, name)))
    axes[0].set_ylabel(label(_named(run, "z")))
    moving = " and in motion" if "time" in run else ""
    headline(figure, f"{title}: shape at rest{moving}, lateral scale enlarged")
    key(figure, axes[0])
    return figure


def _named(run: xr.Dataset, name: str) -> xr.DataArray:
    values: xr.DataArray = run[name] if name in run else run[f"{name}_static"].rename(name)
    return values


def _panel(ax: Axes, run: xr.Dataset, name: str) -> None:
    if "time" in run and {name, "z"} <= set(run):
        across, up = read(run[name]).values, read(run["z"]).values
        time, s = run["time"].values, read(run["s"]).values
        for k in evenly_spaced(len(time), SNAPSHOTS):
            ax.plot(across[k], up[k], color=GREY, linewidth=0.4, alpha=0.7)
        most = int(np.nanargmax(np.nanmax(across, axis=0) - np.nanmin(across, axis=0)))
        there = across[:, most]
        for colour, word, k in zip(COLOURS, SIDES, (there.argmax(), there.argmin()), strict=False):
            text = f"{time[k]:.5g} s: {name} {word} at s = {float(s[most]):.5g} {read_in('m').unit}"
            ax.plot(across[k], up[k], color=colour, label=text)
    if f"{name}_static" in run and "z_static" in run:
        ax.plot(read(run[f"{name}_static"]), read(run["z_static"]), color="black", label="at rest")
