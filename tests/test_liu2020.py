"""What is derived and graded in the chapter on Liu et al. 2020."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.derived.liu2020_motion import lag_at

DEPTHS = (100.0, 200.0, 300.0, 400.0)


def travelling(speed, periods):
    """A wave that runs down from the ring at 533 m with no loss (m); time over two of the longest."""
    nodes = np.arange(0.0, 534.0, 6.5)
    s = xr.DataArray(nodes, dims="s", coords={"s": nodes})
    time = np.arange(0.0, 2.0 * max(periods) + 0.01, 0.025)
    t = xr.DataArray(time, dims="time", coords={"time": time})
    period = xr.DataArray(list(periods), dims="roll_period", coords={"roll_period": list(periods)})
    return np.cos(2.0 * np.pi / period * (t - (533.0 - s) / speed))


@pytest.mark.parametrize("down", [1, -1])
def test_a_lag_of_more_than_half_a_turn_from_depth_to_depth_is_told_whole(down):
    """At 31.9 m/s a wave of 5 s lags by 226 degrees every 100 m, which read as -134 at the depths alone."""
    periods = (5.0, 10.0)
    lag = lag_at(DEPTHS, travelling(31.9 * down, periods), "roll_period")
    for period in periods:
        exact = down * 2.0 * np.pi * np.array(DEPTHS) / (31.9 * period)
        assert period > 5.0 or np.diff(exact)[0] * down > np.pi
        # depths lie between nodes, cubic interpolation over 1/24 of a wave
        np.testing.assert_allclose(lag.sel(roll_period=period), exact, rtol=1e-4)
