"""What is missing in a curve never becomes an answer: of seeded curves with missing values."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.dataset.crossing import first_crossing, first_limit
from riserstudy.dataset.place_of_crossing import place_of_crossing
from riserstudy.design.watch_circles import (
    CIRCLE,
    NEVER,
    TOO_LATE,
    UNKNOWN,
    red_and_yellow,
    watch_circle,
    with_flags,
)

LEVEL = 1.0


def curves(seed, count=200):
    """Walks of 2 to 30 points from below the level; about half of them reach it."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        n = int(rng.integers(2, 31))
        place = np.cumsum(rng.uniform(0.1, 2.0, n))
        yield rng, np.cumsum(rng.normal(0.0, 0.5, n)), place


@pytest.mark.parametrize("seed", range(5))
def test_of_a_curve_without_values_it_is_not_known_when_it_reaches_a_level(seed):
    for rng, curve, place in curves(seed):
        nothing = np.full_like(curve, np.nan)
        assert np.isnan(place_of_crossing(nothing, rng.normal(), place))


@pytest.mark.parametrize("seed", range(5))
def test_values_missing_within_a_curve_leave_an_answer_as_it_is_or_make_it_unknown(seed):
    never = reached = unknown = 0
    for rng, curve, place in curves(seed):
        whole = place_of_crossing(curve, LEVEL, place)
        assert not np.isnan(whole)
        missing = rng.random(len(curve)) < 0.1
        missing[-1] = False  # the curve ends where it ends
        found = place_of_crossing(np.where(missing, np.nan, curve), LEVEL, place)
        assert found == whole or (np.isnan(found) and missing.any())
        if missing[place <= whole].any():  # a value before the crossing, or any where there is none
            assert np.isnan(found)
        never, reached = never + (found == np.inf), reached + np.isfinite(found)
        unknown += np.isnan(found)
    assert min(never, reached, unknown) > 10  # each of them was met


@pytest.mark.parametrize("seed", range(5))
def test_missing_values_after_its_end_are_those_of_a_shorter_curve(seed):
    for rng, curve, place in curves(seed):
        n = int(rng.integers(1, len(curve) + 1))
        padded = np.where(np.arange(len(curve)) < n, curve, np.nan)
        short = place_of_crossing(curve[:n], LEVEL, place[:n])
        assert place_of_crossing(padded, LEVEL, place) == short


@pytest.mark.parametrize("seed", range(5))
def test_the_curve_is_at_the_level_where_it_reaches_it_and_below_before(seed):
    for _, curve, place in curves(seed):
        found = place_of_crossing(curve, LEVEL, place)
        before = curve[place < found]
        assert (before < LEVEL).all()
        if np.isfinite(found) and curve[0] < LEVEL:
            assert np.interp(found, place, curve) == pytest.approx(LEVEL, abs=1e-12)


def test_without_the_time_of_a_limit_neither_the_first_nor_a_watch_circle_is_known():
    time = np.arange(0.0, 101.0)
    runs = xr.DataArray(
        [0.02 * time, np.full_like(time, np.nan), 0.0 * time],
        dims=("limit", "time"),
        coords={"limit": ["reached", "missing", "never reached"], "time": time},
    )
    times = first_crossing(runs, LEVEL)
    np.testing.assert_allclose(times, [50.0, np.nan, np.inf])
    names = [str(first_limit(times.isel(limit=k)).item()) for k in ([0, 2], [0, 1], [2], [1, 2])]
    assert names == ["reached", "unknown", "none", "unknown"]
    offset = runs.sel(limit="reached", drop=True)
    circle = watch_circle(times.min("limit", skipna=False), offset, 10.0)
    assert int(circle["circle_outcome"]) == UNKNOWN
    assert np.isnan(float(circle["circle_radius"]))


@pytest.mark.parametrize("seed", range(5))
def test_each_outcome_of_a_circle_has_a_meaning(seed):
    """Of a drift at constant speed, so that every radius is known; the flags are named in their order."""
    draw = np.random.default_rng(seed)
    speed, eds, prepare = draw.uniform(0.1, 2.0), draw.uniform(10.0, 30.0), draw.uniform(5.0, 9.0)
    time = np.arange(0.0, 101.0)
    offset = xr.DataArray(speed * time, dims="time", coords={"time": time})
    first = xr.DataArray([draw.uniform(50.0, 100.0), 0.9 * eds, np.inf, np.nan], dims="run")
    found = with_flags(red_and_yellow(first, offset, [f"{eds} s"], f"{prepare} s")).isel(eds_time=0)
    words = ["circle", "even_an_alarm_at_the_start_is_too_late", "no_limit_is_reached", "not_known"]
    for colour, before in (("red", eds), ("yellow", eds + prepare)):
        outcome = found[f"{colour}_circle_outcome"]
        assert outcome.values.tolist() == [CIRCLE, TOO_LATE, NEVER, UNKNOWN]
        meanings = outcome.attrs["flag_meanings"].split()
        named = dict(zip(outcome.attrs["flag_values"].tolist(), meanings, strict=True))
        assert [named[code] for code in outcome.values.tolist()] == words
        radius = [speed * (float(first[0]) - before), 0.0, speed * 100.0, np.nan]
        np.testing.assert_allclose(found[f"{colour}_circle_radius"], radius)
        assert "flag_values" not in found[f"{colour}_circle_radius"].attrs
