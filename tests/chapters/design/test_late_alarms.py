"""Marks of alarms that are too late: which alarm, and in which currents."""

import numpy as np
import pytest
import xarray as xr

from chapters.design.figures.watch_circles import watch_circles
from riserstudy.design.watch_circles import TOO_LATE

SPEEDS = np.linspace(0.0, 1.6, 5)
TIMES = (30.0, 60.0, 90.0)


def drawn_of(seed):
    """Alarms of two muds; from a random current on, alarms of some disconnect times are too late."""
    draw = np.random.default_rng(seed)
    over = ("surface_speed", "mud_weight", "eds_time")
    first = draw.integers(0, len(SPEEDS) + 1, (2, 3))  # first late current, of red and yellow
    late = {name: np.arange(len(SPEEDS))[:, None] >= first[k] for k, name in enumerate(("red", "yellow"))}
    values = {"limit_offset": (over[:2], np.full((len(SPEEDS), 2), 100.0))}
    for name, radius in (("red", 50.0), ("yellow", 20.0)):
        of_muds = np.repeat(late[name][:, None, :], 2, axis=1)
        values[f"{name}_circle_radius"] = (over, np.where(of_muds, 0.0, radius))
        values[f"{name}_circle_outcome"] = (over, np.where(of_muds, TOO_LATE, 0))
    coordinates = {"surface_speed": SPEEDS, "mud_weight": [1100.0, 1800.0], "eds_time": list(TIMES)}
    return watch_circles(xr.Dataset(values, coordinates)), late


@pytest.mark.parametrize("seed", range(9))
def test_each_late_alarm_has_a_row_of_crosses_below_zero_with_its_name(seed):
    """Without rows, crosses of two disconnect times would coincide at a radius of zero."""
    figure, late = drawn_of(seed)
    wanted = {
        f"{name}, {eds:g} s": SPEEDS[late[name][:, k]].tolist()
        for name in late
        for k, eds in enumerate(TIMES)
        if late[name][:, k].any()
    }
    for ax in figure.axes[:2]:
        rows = [line for line in ax.lines if line.get_marker() == "x"]
        heights = {float(np.unique(row.get_ydata()).item()) for row in rows}
        names = {text.xy[1]: text.get_text() for text in ax.texts if text.xy[1] in heights}
        found = {names[float(row.get_ydata()[0])]: row.get_xdata().tolist() for row in rows}
        assert found == wanted
        assert len(heights) == len(rows)
        assert all(ax.get_ylim()[0] < height < 0.0 for height in heights)
