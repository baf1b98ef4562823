"""Figures of Chang et al. 2020."""

from __future__ import annotations

import xarray as xr
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, panels

READINGS = {
    "steady": "settled",
    "from_rest": "first 100 s from rest",
    "quasi_static": "quasi-static",
}


def fig14(asymmetry: xr.Dataset) -> Figure:
    """Asymmetry index over heave amplitude."""
    figure, (ax,) = panels()
    index = asymmetry["asymmetry_index"]
    for colour, (reading, label) in zip(COLOURS, READINGS.items(), strict=False):
        for model, line in (("gas law", "-"), ("linear", "--")):
            curve = index.sel(reading=reading, tensioner_model=model)
            ax.plot(curve["heave_amplitude"], curve, line, color=colour, label=f"{label}, {model}")
    ax.set_xlabel("heave amplitude (m)")
    ax.set_ylabel("asymmetry index S (-)")
    ax.legend(fontsize="small")
    return figure
