"""What is printed of hours of which none is workable."""

import numpy as np
import xarray as xr

from riserstudy.cli.downtime_lines import Ahead, show_hours
from riserstudy.seas.hours import hours, sea_limit


def test_a_wait_that_never_ends_is_a_dash(capsys):
    time = np.datetime64("2000-01-01") + np.arange(24 * 800) * np.timedelta64(1, "h")
    sea = xr.Dataset({"significant_wave_height": ("time", np.full(len(time), 3.0))}, {"time": time})
    sea.attrs["interval_hours"] = 1.0
    show_hours(hours(sea, [sea_limit("hs <= 2 m")]), [24.0], Ahead(10, 0.66))
    printed = capsys.readouterr().out
    assert "nan" not in printed
    assert "all           –       –       –  19200" in printed
