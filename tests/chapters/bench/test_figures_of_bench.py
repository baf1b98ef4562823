"""Figures of the bench scenes, of runs whose answer is known."""

import numpy as np
import xarray as xr
from drawn_whole import assert_whole

from chapters.bench.figures import heave, surge
from riserstudy.figures.figure_text import headline

NODES = np.linspace(0.0, 533.0, 9)
TIME = np.arange(0.0, 60.0, 1.0)


def surging(largest, smallest):
    """A run in surge with extremes of its moment (N m)."""
    swing = np.sin(TIME)[:, None] * np.ones(NODES.size)
    along = np.ones(NODES.size)
    return xr.Dataset(
        {
            "x": (("time", "s"), swing),
            "effective_tension": (("time", "s"), 2.3e6 + 1e5 * swing),
            "bending_moment_max": ("s_node", largest * along),
            "bending_moment_min": ("s_node", smallest * along),
        },
        {"time": TIME, "s": NODES, "s_node": NODES},
    )


def test_the_largest_moment_is_that_of_either_side_of_its_envelope():
    figure = surge(surging(50e3, -100e3), surging(60e3, -90e3))
    assert figure.axes[1].get_title(loc="left") == "(b) largest moment 100 and 90 kN m"
    assert figure.axes[2].get_title(loc="left") == "(c) amplitude in S2c: 100 kN"
    assert headline(figure) == "Surge with constant top tension, and with the top held at its height"


def test_equal_largest_moments_are_told_in_the_title():
    figure = surge(surging(50e3, -100e3), surging(99e3, -90e3))
    assert headline(figure) == "Holding the top's height changes the tension, but hardly the largest moment"


def test_the_key_of_surge_is_within_the_figure():
    assert_whole(surge(surging(50e3, -100e3), surging(60e3, -90e3)))


def test_a_riser_stretches_where_its_lower_end_lags_below_the_top():
    """The lower end is at most 30 mm below the top's motion, and 50 mm above it in compression."""
    top = np.sin(TIME)
    apart = np.where(TIME == 20.0, 0.05, np.where(TIME == 30.0, -0.03, 0.0))
    z = np.column_stack([top + apart, 500.0 + top])
    run = xr.Dataset(
        {
            "z": (("time", "s"), z),
            "z_static": ("s_node", [0.0, 500.0]),
            "effective_tension": (("time", "s"), np.full(z.shape, 6e6)),
        },
        {"time": TIME, "s": [0.0, 500.0], "s_node": [0.0, 500.0]},
    )
    assert headline(heave(run)) == "Heave of ±1 m stretches the riser by 30 mm in steady state"
