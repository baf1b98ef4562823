"""Responses exceeded once in many years, where the distribution of every hour is known."""

import math

import numpy as np
import pytest

from riserstudy.dataset.statistics import NOT_EXCEEDED
from riserstudy.errors import InputError
from riserstudy.scene.limits import Limit
from riserstudy.seas.riser_hours import Met
from riserstudy.seas.riser_returns import Demands, returned, table_of

INTERVAL = 6.0  # h
A_YEAR = 1461  # rows
YEARS = 20
RUNS = 6.0  # length of an interval, in runs of the riser
REDUCED = -math.log(-math.log(NOT_EXCEEDED))
LARGEST = Limit(output="ufj_angle", largest="4 deg", mode="drilling")
SMALLEST = Limit(output="effective_tension", smallest="100 kN", mode="connected")


def mode_and_scale(height):
    """Of the Gumbel distribution of the largest response of an interval."""
    return 0.5 * height**1.2, 0.08 * height


def heights(count, seed):
    """Independent from row to row, so that the distribution of a year is that of its rows to a power."""
    return 1.8 * np.exp(0.4 * np.random.default_rng(seed).standard_normal(count))


def demands(height, limit=LARGEST, off=0.0, seeds=100_000, sign=1.0):
    """A record of such rows."""
    mode, scale = mode_and_scale(height)
    step = np.timedelta64(6, "h")
    time = np.datetime64("2001-01-01T00", "h") + step * np.arange(len(height))
    flags = np.ones((len(height), 1), bool)
    offs = [np.full(len(height), one) for one in (off, 0.0, 0.0)]
    columns = [one[:, None] for one in (sign * (mode + REDUCED * scale), *offs, scale)]
    return Demands(time, INTERVAL, RUNS, seeds, [limit], Met(flags, flags, flags, *columns))


def true_value(years):
    """By the distribution of a row, over all heights, to the power of the rows of a year."""
    normal = (np.arange(20000) + 0.5) / 20000
    from scipy.stats import norm

    mode, scale = mode_and_scale(1.8 * np.exp(0.4 * norm.ppf(normal)))
    low, high = 1.0, 60.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        over = np.mean(-np.expm1(-np.exp(-(middle - mode) / scale)))
        low, high = (middle, high) if A_YEAR * math.log1p(-over) < math.log1p(-1.0 / years) else (low, middle)
    return low


def test_the_true_value_is_that_of_drawn_years():
    """So that what others are compared with is not trusted by one way alone."""
    draw = np.random.default_rng(5)
    mode, scale = mode_and_scale(heights(A_YEAR * 2000, 5))
    largest = (mode + scale * draw.gumbel(size=len(mode))).reshape(2000, A_YEAR).max(axis=1)
    assert np.quantile(largest, 1.0 - 1.0 / 50.0) == pytest.approx(true_value(50.0), rel=0.05)


@pytest.mark.long
def test_bands_hold_the_true_value_about_nine_times_in_ten_by_both_methods():
    truth = true_value(50.0)
    held = {"by_years": 0, "by_storms": 0}
    values = []
    for seed in range(40):
        (one,) = returned(demands(heights(A_YEAR * YEARS, seed)), [50], seed)
        for way in held:
            of = getattr(one, way)
            held[way] += of.low <= truth <= of.high
        values.append(one.by_years.value)
    assert all(count >= 30 for count in held.values()), held
    assert np.mean(values) == pytest.approx(truth, rel=0.1)


@pytest.mark.long
def test_extremes_within_an_interval_add_to_those_of_the_sea_state():
    """More than with each row at its mode, less than with each at what nine in ten do not exceed."""
    whole = demands(heights(A_YEAR * YEARS, 1))
    scale = whole.rows.scale
    values = []
    for demand, spread in (
        (whole.rows.demand - REDUCED * scale, 0.0 * scale),
        (whole.rows.demand, scale),
        (whole.rows.demand, 0.0 * scale),
    ):
        rows = whole.rows._replace(demand=demand, scale=spread)
        values.append(returned(whole._replace(rows=rows), [50])[0].by_years.value)
    assert values == sorted(values)
    assert values[0] < 0.95 * values[1]


@pytest.mark.long
def test_what_is_not_known_of_the_response_widens_the_band():
    height = heights(A_YEAR * YEARS, 2)
    widths = []
    for off, seeds in ((0.0, 100_000), (1.0, 100_000), (1.0, 5)):
        (one,) = returned(demands(height, off=off, seeds=seeds), [50])
        widths.append(one.by_years.high - one.by_years.low)
    assert widths[0] < widths[1] < widths[2]
    assert widths[1] > 1.9  # of 90 % of a normal distribution that is 1 to each side


def test_a_smallest_value_is_the_mirror_of_a_largest():
    height = heights(A_YEAR * YEARS, 3)
    (large,) = returned(demands(height), [20])
    (small,) = returned(demands(height, SMALLEST, sign=-1.0), [20])
    for one, other in ((large.by_years, small.by_years), (large.by_storms, small.by_storms)):
        np.testing.assert_allclose([-one.value, -one.high, -one.low], other, rtol=1e-12)


def test_longer_periods_have_larger_values_and_each_a_band():
    rows = table_of(returned(demands(heights(A_YEAR * YEARS, 4)), [10, 100])).rows
    for row in rows:
        assert row[3] < row[2] < row[4]
        assert row[6] < row[5] < row[7]
    assert rows[0][2] < rows[1][2]


@pytest.mark.parametrize("seeds, years, told", [(1, 20, "--seeds 5 or more"), (5, 3, "5 or more such years")])
def test_what_cannot_be_known_is_refused(seeds, years, told):
    with pytest.raises(InputError, match=told):
        returned(demands(heights(A_YEAR * years, 6), seeds=seeds), [50])


@pytest.mark.parametrize("seed", range(4))
def test_rows_whose_runs_failed_leave_no_return_value(seed):
    """Runs fail in the highest seas, so that the other rows have too small responses."""
    height = heights(A_YEAR * YEARS, seed)
    of = demands(height)
    failed = height >= np.quantile(height, np.random.default_rng(seed).uniform(0.97, 0.9999))
    demand = np.where(failed[:, None], np.nan, of.rows.demand)
    for one in returned(of._replace(rows=of.rows._replace(demand=demand)), [10, 50]):
        assert np.isnan([*one.by_years, *one.by_storms]).all()
