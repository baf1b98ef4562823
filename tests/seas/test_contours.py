"""Environmental contours of a record whose distribution is known; skipped without the optional library."""

import sys

import numpy as np
import pytest
import xarray as xr
from scipy.stats import norm

from riserstudy.errors import InputError
from riserstudy.seas.contours import contour, doubts
from riserstudy.seas.synthetic import synthetic

SHAPE, SCALE = 1.5, 2.0  # of a Weibull distribution (m)


def record(years, seed):
    """Independent heights by a Weibull distribution, and periods of their own by a log-normal one."""
    draw = np.random.default_rng(seed)
    ends = (np.datetime64(f"{2001 + k}-01-01T00", "h") for k in (0, years))
    time = np.arange(*ends, np.timedelta64(6, "h"))
    height = SCALE * draw.weibull(SHAPE, len(time))
    period = np.exp(1.6 + 0.25 * np.sqrt(height) + 0.12 * draw.standard_normal(len(time)))
    return xr.Dataset(
        {"significant_wave_height": ("time", height), "peak_period": ("time", period)},
        {"time": time.astype("datetime64[ns]")},
        {"interval_hours": 6.0},
    )


def test_the_highest_sea_is_that_of_the_distribution_of_heights():
    """By the method: the height at its top is exceeded once in the return period, whatever the period."""
    pytest.importorskip("virocon")
    years = 50.0
    table = contour(record(20, 1), years)
    heights = np.array([row[1] for row in table.rows])
    true = SCALE * np.log(years * 8766.0 / 6.0) ** (1.0 / SHAPE)
    assert heights.max() == pytest.approx(true, rel=0.05)
    top = table.rows[int(heights.argmax())]
    assert top[2] <= true * 1.03
    assert true * 0.97 <= top[3]
    assert np.log(top[4]) == pytest.approx(1.6 + 0.25 * np.sqrt(top[1]), abs=0.1)
    for row in table.rows:
        assert row[2] < row[3] or row[1:4] == [0.0, 0.0, 0.0]  # the least height of a fit may be below zero
        assert row[5] < row[6]


@pytest.mark.parametrize("seed", range(3))
def test_calm_rows_are_time_without_seas(seed):
    """A record of which half is calm has the contour of its seas for half of the return period."""
    pytest.importorskip("virocon")
    whole = record(8, seed)
    height = whole["significant_wave_height"].values
    calm = np.arange(len(height)) % 2 == 1
    half = whole.copy(deep=True)
    half["significant_wave_height"][calm] = 0.0
    half["peak_period"][calm] = np.nan
    seas = whole.isel(time=~calm)
    seas.attrs["interval_hours"] = 12.0
    found, expected = contour(half, 50.0), contour(seas, 50.0)
    columns = [[row[k] for k in (1, 4)] for row in found.rows]
    np.testing.assert_allclose(columns, [[row[k] for k in (1, 4)] for row in expected.rows])


@pytest.mark.parametrize("seed", [0, 3, 4, 5])
def test_no_place_has_a_height_below_zero_or_no_period(seed):
    """Also where the least height of the fit is below zero, as it often is of calm seas."""
    pytest.importorskip("virocon")
    found = contour(record(6, seed), 50.0)
    values = np.array([row[1:] for row in found.rows], float)
    assert np.isfinite(values).all()
    assert values[:, :3].min() >= 0.0
    lowest = values[12]  # half-way round, where a longer and a shorter period have the same chance
    assert lowest[0] == values[:, 0].min()
    assert lowest[3] == pytest.approx(np.exp(1.6), rel=0.05)


def test_a_longer_period_encloses_a_shorter_one():
    pytest.importorskip("virocon")
    short, long = (contour(record(10, 2), years) for years in (1.0, 100.0))
    for k in (1, 4):
        values = [np.array([row[k] for row in table.rows]) for table in (short, long)]
        assert np.ptp(values[0]) < np.ptp(values[1])


def spread(seed):
    """A record in which the logarithm of the period has the same spread at all heights, with its law."""
    draw = np.random.default_rng(seed)
    one = record(6, seed)
    height = float(10.0 ** draw.uniform(-0.6, 0.3)) * one["significant_wave_height"].values
    deviation = float(draw.uniform(0.06, 0.15))
    period = np.exp(1.4 + 0.4 * np.sqrt(height) + deviation * draw.standard_normal(len(height)))
    values = {"significant_wave_height": ("time", height), "peak_period": ("time", period)}
    return one.assign(values), deviation


@pytest.mark.parametrize("seed", range(20))
def test_periods_are_those_of_the_distribution_at_every_height(seed):
    """Also at heights without sea states in the record, for which the fitted functions are extrapolated."""
    pytest.importorskip("virocon")
    one, deviation = spread(seed)
    rows = np.array(contour(one, 50.0).rows, float)
    beta = norm.isf(6.0 / (50.0 * 8766.0))
    normal = beta * np.sin(2.0 * np.pi * np.arange(len(rows)) / len(rows))
    true = 1.4 + 0.4 * np.sqrt(rows[:, 1]) + deviation * normal
    off = np.abs(np.log(rows[:, 4]) - true)
    assert off.max() <= 0.2
    # above a tenth of the record's seas, where fits to bins of half a metre have errors of up to 2 % and more
    assert off[rows[:, 1] > np.quantile(one["significant_wave_height"], 0.1)].max() <= 0.06


@pytest.mark.parametrize("seed", range(3))
def test_periods_of_swell_and_wind_waves_are_doubted(seed):
    pytest.importorskip("virocon")
    one, _ = spread(seed)
    assert not doubts(one, contour(one, 50.0))
    draw = np.random.default_rng(seed)
    two = record(6, seed)
    height = two["significant_wave_height"].values
    swell, wind = 12.0 + draw.standard_normal(len(height)), np.maximum(4.5 * np.sqrt(height), 1.5)
    two["peak_period"][:] = np.where(draw.random(len(height)) < 0.5, swell, wind)
    table = contour(two, 50.0)
    (line,) = doubts(two, table)
    assert f"{max(row[4] for row in table.rows):.2g} s" in line


def test_too_few_heights_are_one_line():
    pytest.importorskip("virocon")
    low = record(6, 1)
    low["significant_wave_height"][:] *= 0.1
    with pytest.raises(InputError, match="cannot be fitted"):
        contour(low, 50.0)


def test_without_the_library_one_line_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "virocon", None)
    with pytest.raises(InputError, match=r"install it with pip install 'riserstudy\[contours\]'"):
        contour(synthetic(6, 1), 50.0)


@pytest.mark.long
def test_bands_contain_the_true_contour():
    """At all points with waves above the mean height; neighbouring points have the same errors.

    By years drawn with replacement and periods by bins, they contained 60 % of heights and of periods.
    """
    pytest.importorskip("virocon")
    beta, count = norm.isf(6.0 / (50.0 * 8766.0)), 40
    normal = 2.0 * np.pi * np.arange(24) / 24
    height = SCALE * (-norm.logsf(beta * np.cos(normal))) ** (1.0 / SHAPE)
    period = np.exp(1.6 + 0.25 * np.sqrt(height) + 0.12 * beta * np.sin(normal))
    held = np.zeros((2, 24))
    for seed in range(count):
        rows = np.array(contour(record(6, seed + 50), 50.0).rows, float)
        held[0] += (rows[:, 2] <= height) & (height <= rows[:, 3])
        held[1] += (rows[:, 5] <= period) & (period <= rows[:, 6])
    share = held[:, height > 2.0].mean(axis=1) / count
    assert share.min() >= 0.78  # nine in ten, and 2.5 standard errors
    assert share.max() <= 0.98


@pytest.mark.parametrize("every, seed", [(2, 0), (3, 1)])
def test_rows_without_a_period_change_no_contour(every, seed):
    """Against the record without these rows, of which each stands for a longer interval."""
    pytest.importorskip("virocon")
    whole = record(6, seed)
    lacking = whole.copy(deep=True)
    lacking["peak_period"][np.arange(whole.sizes["time"]) % every != 0] = np.nan
    few = whole.isel(time=slice(None, None, every)).assign_attrs(interval_hours=6.0 * every)
    assert contour(lacking, 50.0).rows == contour(few, 50.0).rows


@pytest.mark.parametrize("seed", range(2))
def test_too_few_periods_are_named(seed):
    """Periods are missing at random: the record itself is complete."""
    pytest.importorskip("virocon")
    one = record(6, seed)
    lost = np.random.default_rng(seed).random(one.sizes["time"]) < 0.4
    with pytest.raises(InputError, match="only 0 of 6 years have a height and a period in at least 80%"):
        contour(one.assign(peak_period=one["peak_period"].where(~lost)), 50.0)
