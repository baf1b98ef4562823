"""When limits are reached, and watch circles, of histories whose answer is known."""

import numpy as np
import pytest
import xarray as xr

from chapters.liu2017.limits import LIMITS, reached, shares, starts
from riserstudy.dataset.crossing import first_crossing, first_limit
from riserstudy.design.watch_circles import CIRCLE, NEVER, TOO_LATE, watch_circle

TIME = np.arange(0.0, 101.0)


def history(values):
    return xr.DataArray(np.asarray(values, float), dims="time", coords={"time": TIME})


def runs(**slopes):
    """A platform that moves 2 m a second; shares of limits that grow by so much a second."""
    made = {limit.variable: history(0.0 * TIME) for limit in LIMITS.values()}
    made |= {LIMITS[name].variable: LIMITS[name].most * history(k * TIME) for name, k in slopes.items()}
    return xr.Dataset(made | {"platform_offset": history(2.0 * TIME)})


def test_a_crossing_lies_between_outputs_and_is_infinite_where_there_is_none():
    assert float(first_crossing(history(TIME**2), 6.5)) == pytest.approx(2.5)
    assert float(first_crossing(history(0.0 * TIME), 1.0)) == np.inf
    assert float(first_crossing(history(0.0 * TIME), 0.0)) == 0.0


def test_the_first_limit_is_named():
    found = runs(**{"upper flex joint": 0.02, "wellhead": -0.04})
    times = reached(found)
    assert float(times.sel(limit="upper flex joint")) == pytest.approx(50.0)
    assert float(times.sel(limit="wellhead")) == pytest.approx(25.0)
    assert str(first_limit(times).item()) == "wellhead"
    assert str(first_limit(reached(runs())).item()) == "none"
    assert list(shares(found)["limit"].values) == list(LIMITS)


@pytest.mark.parametrize(
    "before, outcome, radius", [(20.0, CIRCLE, 60.0), (50.0, TOO_LATE, 0.0), (60.0, TOO_LATE, 0.0)]
)
def test_a_watch_circle_is_as_early_as_the_disconnect_is_long(before, outcome, radius):
    found = runs(**{"upper flex joint": 0.02})
    circle = watch_circle(reached(found).min("limit"), found["platform_offset"], before)
    assert int(circle["circle_outcome"]) == outcome
    assert float(circle["circle_radius"]) == pytest.approx(radius)


def test_where_no_limit_is_reached_every_offset_is_allowed():
    circle = watch_circle(reached(runs()).min("limit"), runs()["platform_offset"], 60.0)
    assert int(circle["circle_outcome"]) == NEVER
    assert float(circle["circle_radius"]) == pytest.approx(200.0)


def test_a_response_begins_with_a_change_from_rest_whatever_its_sign():
    """From -0.04 through zero to +0.01 of the limit at 5 s: a size would not have changed by so much."""
    found = runs(wellhead=-0.001)
    most = LIMITS["upper flex joint"].most
    found["ufj_angle"] = most * history(0.01 * TIME - 0.04)
    begins = starts(found, 0.05)
    assert float(begins.sel(limit="upper flex joint")) == pytest.approx(5.0)
    assert float(begins.sel(limit="wellhead")) == pytest.approx(50.0)
    assert float(begins.sel(limit="conductor")) == np.inf
