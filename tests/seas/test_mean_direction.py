"""The mean direction in the summary of a record."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from riserstudy.cli.seas import described

DIRECTION = "wave_from_direction"


def row_of(bearings):
    """The cells of the directions in a summary: mean, 99 % fractile, largest, missing."""
    time = pd.date_range("2003-01-01", periods=len(bearings), freq="3h")
    sea = {DIRECTION: ("time", bearings, {"units": "degree"})}
    record = xr.Dataset(sea, {"time": time}, {"interval_hours": 3.0, "conversions": ""})
    (line,) = [line for line in described(record) if line.startswith(DIRECTION)]
    return line.split()[2:]


@pytest.mark.parametrize("seed", range(8))
def test_the_mean_direction_turns_with_the_directions(seed):
    """Directions around north have a mean near north, wherever the circle is cut; no largest value."""
    draw = np.random.default_rng(seed)
    spread, way = draw.uniform(2.0, 40.0), draw.uniform(0.0, 360.0)
    around = draw.normal(0.0, spread, 400)
    around -= np.degrees(np.angle(np.exp(1j * np.radians(around)).mean()))
    for turn in (0.0, 90.0, 180.0, way):
        bearings = (around + turn) % 360.0
        bearings[draw.integers(0, 400, 20)] = np.nan
        mean, fractile, largest, missing = row_of(bearings)
        apart = (float(mean) - turn + 180.0) % 360.0 - 180.0
        assert abs(apart) < spread / 2.0
        assert (fractile, largest) == ("-", "-")
        assert int(missing) == np.isnan(bearings).sum()


def test_directions_that_cancel_have_no_mean():
    assert row_of(np.array([0.0, 180.0, 90.0, 270.0]))[0] == "-"
    assert row_of(np.array([350.0, 10.0]))[0] == "0.0"
    assert row_of(np.full(3, np.nan))[0] == "-"
