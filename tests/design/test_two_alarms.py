"""Red and yellow watch circles of datasets, against the platform's own way read backwards."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.design.watch_circles import CIRCLE, NEVER, TOO_LATE, UNKNOWN, red_and_yellow


@pytest.mark.parametrize("seed", range(6))
def test_each_alarm_is_as_much_earlier_as_what_follows_it_takes(seed):
    """Of a platform that drives off at a constant acceleration; minutes and seconds are one time."""
    draw = np.random.default_rng(seed)
    acceleration = draw.uniform(0.005, 0.05)
    time = np.linspace(0.0, 300.0, 30001)
    offset = xr.DataArray(0.5 * acceleration * time**2, {"time": time}, "time")
    firsts = np.array([*draw.uniform(5.0, 290.0, 8), np.inf, np.nan])
    first = xr.DataArray(firsts, dims="case")
    eds, preparing = draw.uniform(10.0, 60.0, 3), draw.uniform(5.0, 90.0)
    found = red_and_yellow(first, offset, [f"{s!r} s" for s in eds.tolist()], f"{preparing / 60.0!r} min")
    for name, before in (("red", 0.0), ("yellow", preparing)):
        for k, seconds in enumerate(eds):
            alarm = firsts - seconds - before
            expected = np.where(alarm > 0.0, 0.5 * acceleration * alarm**2, 0.0)
            outcome = np.where(alarm > 0.0, CIRCLE, TOO_LATE)
            expected[-2:], outcome[-2:] = (offset[-1], np.nan), (NEVER, UNKNOWN)
            one = found.isel(eds_time=k)
            np.testing.assert_allclose(one[f"{name}_circle_radius"], expected, rtol=1e-4, atol=1e-6)
            np.testing.assert_array_equal(one[f"{name}_circle_outcome"], outcome)
