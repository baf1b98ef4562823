"""Which way the riser is deflected at first, and which disconnects are in time."""

import numpy as np
import pytest
import xarray as xr

from chapters.liu2017.claims import deflects_along_at_first
from chapters.liu2017.figures.limits import _slowest_in_time
from riserstudy.design.watch_circles import TOO_LATE


def started(low, top):
    """Angles (rad) of both ends at the start of runs along the environment and against it."""
    values = {"lfj_angle": low, "ufj_angle": top}
    both = {name: (("heading", "time"), [[x, 0.0], [0.0, 0.0]]) for name, x in values.items()}
    return xr.Dataset(both, {"heading": ["along", "against"], "time": [0.0, 1.0]})


@pytest.mark.parametrize("seed", range(10))
def test_a_riser_that_bows_along_leans_so_at_both_ends(seed):
    low, top = np.random.default_rng(seed).uniform(-0.02, 0.02, 2)
    found = deflects_along_at_first(started(low, top))
    assert bool(found.true) == (low > 0.0 > top)
    assert float(found.value) == pytest.approx((low - top) * 180.0 / np.pi)
    assert not (bool(found.true) and bool(deflects_along_at_first(started(-low, -top)).true))


def circles(radii):
    """Red circles (m) by duration of the disconnect and direction."""
    radius = np.array(radii, float)
    dims = ("scenario", "eds_time", "environment_heading")
    outcome = np.where(radius > 0.0, 1 - TOO_LATE if TOO_LATE in (0, 1) else 0, TOO_LATE)
    coords = {"scenario": ["drive-off"], "eds_time": [15.0, 30.0], "environment_heading": [0.0, 180.0]}
    return xr.Dataset(
        {"red_circle_radius": (dims, radius[None]), "red_circle_outcome": (dims, outcome[None])}, coords
    )


def test_a_circle_within_station_keeping_is_too_late():
    wide = circles([[30.0, 40.0], [8.0, 9.0]])
    assert _slowest_in_time(wide, 3.0) == "In a drive-off, a 30 s disconnect is in time"
    assert "a 15 s disconnect is in time; 30 s is too late" in _slowest_in_time(wide, 8.5)
    assert "No tested disconnect" in _slowest_in_time(wide, 35.0)
