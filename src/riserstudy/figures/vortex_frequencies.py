"""Frequencies over elevation: of vortices in a current, and of the modes that may lock in."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, GREY, headline, panels

LABELLED = 20  # largest number of modes with labels


def vortex_frequencies(found: xr.Dataset, title: str) -> Figure:
    """Shedding frequency and modes over elevation, and the largest amplitude of each mode.

    ``found``: from `riserstudy.design.vortex_screening.screening`.
    """
    figure, (left, right) = panels(1, 2, 5.0, sharey=True)
    z = found["z"].values
    left.plot(found["shedding_frequency"], z, color="black", label="vortices shed")
    for k, mode in enumerate(found["mode"].values):
        one = found.isel(mode=k)
        there = np.where(one["excited"].values.astype(bool), z, np.nan)
        frequency = float(one["natural_frequency"])
        left.axvline(frequency, color=GREY, linewidth=0.5)
        label = "mode may lock in" if k == 0 else None
        left.plot(np.full(len(z), frequency), there, color=COLOURS[1], linewidth=2.5, label=label)
        if k < LABELLED:
            place = (frequency, 1.01)
            left.annotate(
                str(mode), place, xycoords=("data", "axes fraction"), ha="center", fontsize="x-small"
            )
    if found.sizes["mode"]:
        _amplitudes(right, found)
    left.set_xlabel("frequency (Hz)")
    left.set_ylabel("elevation (m)")
    right.set_xlabel("amplitude over diameter")
    count = found.sizes["mode"]
    modes = {0: "no mode may lock in", 1: "one mode may lock in"}.get(count, f"{count} modes may lock in")
    headline(figure, f"{title}: {modes}")
    displayed = [ax.get_legend_handles_labels() for ax in (left, right)]
    handles, labels = (displayed[0][k] + displayed[1][k] for k in range(2))
    figure.legend(handles, labels, loc="outside lower center", ncols=4, fontsize="small")
    return figure


def _amplitudes(ax: Axes, found: xr.Dataset) -> None:
    """The largest amplitude of all modes over elevation, and the mode with the largest amplitude."""
    z, every = found["z"], found["relative_amplitude"]
    ax.fill_betweenx(z, every.max("mode"), color="0.85", label="the largest of all modes")
    most = int(found["amplitude"].values.argmax())
    text = f"mode {found['mode'].values[most]}, which swings most"
    ax.plot(every[most], z, color=COLOURS[0], label=text)
    ax.set_xlim(left=0.0)
