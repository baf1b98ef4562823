"""Figures of this study: a function each, named in config/studies/example.yaml."""

import xarray as xr
from matplotlib.figure import Figure

from riserstudy.figures.style import COLOURS, panels


def swing_over_heave(tension_swing: xr.Dataset) -> Figure:
    """Swing of the top tension compared with the straight line through its first value."""
    figure, (ax,) = panels()
    swing = tension_swing["tension_swing"] / 1e3
    amplitude = swing["heave_amplitude"]
    ax.plot(amplitude, swing, "o-", color=COLOURS[0], label="simulated")
    straight = amplitude * float(swing[0] / amplitude[0])
    ax.plot(amplitude, straight, "--", color=COLOURS[1], label="proportional to heave")
    ax.set_xlabel("heave amplitude (m)")
    ax.set_ylabel("amplitude of top tension (kN)")
    ax.set_title("Range of the top tension over the heave amplitude")
    ax.legend()
    return figure
