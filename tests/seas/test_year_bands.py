"""Bands of workable hours from few years: they hold what comes as often as they say."""

import importlib.util
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import binom, t

from riserstudy.errors import InputError
from riserstudy.seas import year_bands
from riserstudy.seas.hours import hours, sea_limit
from riserstudy.seas.synthetic import synthetic
from riserstudy.seas.year_bands import band, band_of_next, covariance
from riserstudy.seas.years import Year

ROOT = Path(__file__).resolve().parents[2]


def script():
    """What draws records and counts."""
    where = ROOT / "workflow/scripts/band_coverage.py"
    spec = importlib.util.spec_from_file_location("band_coverage", where)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def drawn(monkeypatch):
    """That script, with fewer draws of each band."""
    monkeypatch.setattr(year_bands, "DRAWS", 2000)
    return script()


def years_of(shares, first=2001):
    """Years of these shares."""
    return [Year(first + k, 8766, share * 8766, 1.0) for k, share in enumerate(shares)]


def within(share, trials, chance):
    """Whether a share of trials is that of a chance, by binomial bounds that one in a thousand exceeds."""
    low, high = binom.ppf([5e-4, 1.0 - 5e-4], trials, chance) / trials
    return low <= share <= high


@pytest.mark.parametrize("seed", range(6))
def test_one_year_that_does_not_depend_on_others_has_the_band_of_student(seed):
    draw = np.random.default_rng(seed)
    values = 1.1 + 0.04 * draw.standard_normal(draw.integers(3, 12))
    n = len(values)
    half = t.ppf(0.95, n - 1) * values.std(ddof=1) * math.sqrt(1.0 + 1.0 / n)
    low, high = np.sin(np.clip([values.mean() - half, values.mean() + half], 0.0, math.pi / 2)) ** 2
    found = band_of_next(years_of(np.sin(values) ** 2), 1, 0.5)
    assert found.share == pytest.approx(np.mean(np.sin(values) ** 2))
    assert (found.low, found.high) == pytest.approx((low, high), abs=0.06 * (high - low))


def test_years_persist_as_increments_of_a_motion_that_scales():
    """The variance of a mean over n years falls by n to the power 2 H - 2, whatever n."""
    for exponent in (0.5, 0.66, 0.74, 0.9):
        for n in (2, 7, 40):
            at = np.arange(n)
            mean = covariance(at[:, None] - at, exponent).mean()
            assert mean == pytest.approx(n ** (2.0 * exponent - 2.0))


@pytest.mark.long
@pytest.mark.parametrize("exponent", [0.5, 0.66, 0.9])
@pytest.mark.parametrize("known, ahead", [(3, 3), (3, 10), (5, 5), (10, 3), (20, 10)])
def test_bands_hold_nine_in_ten_of_years_that_persist_as_is_assumed(drawn, exponent, known, ahead):
    records = list(drawn.noise(exponent, known + ahead, 400, seed=known + ahead))
    of = (drawn.at_exponent(exponent), drawn.with_replacement)
    found, before = drawn.coverage(records, known, of)
    assert within(found, 400, 0.9)
    if known < 10:
        assert not within(before, 400, 0.9)  # whole years drawn with replacement, as bands were


def test_more_persistence_than_is_assumed_leaves_less_in_the_band_and_less_leaves_more(drawn):
    found = [
        drawn.coverage(list(drawn.noise(true, 10, 400)), 5, (drawn.at_exponent(0.66),))[0]
        for true in (0.5, 0.66, 0.9)
    ]
    assert found == sorted(found, reverse=True)
    assert found[0] > 0.9
    assert found[-1] < 0.88


def test_bands_hold_nine_in_ten_of_hourly_seas_that_forget_within_a_year(drawn):
    hourly = [drawn.years_of_seas(seed, 96) for seed in (11, 12)]
    for known, ahead in ((3, 5), (5, 3)):
        records = list(drawn.cut(hourly, known + ahead))
        found = drawn.coverage(records, known, (drawn.at_exponent(0.5),))[0]
        # three limits of one record are not independent: a third of the trials count
        assert within(found, len(records) // 3, 0.9)


@pytest.mark.parametrize("seed", range(4))
def test_the_mean_year_is_that_of_very_many_to_come(seed):
    draw = np.random.default_rng(seed)
    years = years_of(np.sin(1.2 + 0.05 * draw.standard_normal(8)) ** 2)
    mean, many = band(years, 0.5), band_of_next(years, 100, 0.5)
    width = mean.high - mean.low
    assert many.low == pytest.approx(mean.low, abs=0.1 * width)
    assert many.high == pytest.approx(mean.high, abs=0.1 * width)
    assert many.high - many.low < band_of_next(years, 3, 0.5).high - band_of_next(years, 3, 0.5).low


@pytest.mark.parametrize("seed", range(4))
def test_bands_lie_between_nothing_and_all_and_do_not_depend_on_the_calendar(seed):
    draw = np.random.default_rng(seed)
    shares = draw.beta(40.0, 0.4, 4)  # nearly always workable
    one, other = (band_of_next(years_of(shares, first), 5) for first in (1950, 2020))
    assert one == other
    assert 0.0 <= one.low < one.high <= 1.0


def test_a_gap_between_years_tells_more_of_the_mean_where_years_persist():
    years = years_of([0.9, 0.93, 0.88, 0.91])
    apart = [year._replace(year=year.year + 9 * (k > 1)) for k, year in enumerate(years)]
    for exponent, same in ((0.5, True), (0.8, False)):
        assert (band(years, exponent) == band(apart, exponent)) is same


@pytest.mark.parametrize("shares", [[0.9], [0.9, 0.9], [1.0, 1.0, 1.0]])
def test_years_that_tell_no_spread_have_no_band(shares):
    for found in (band(years_of(shares)), band_of_next(years_of(shares), 5)):
        assert math.isnan(found.low)
        assert math.isnan(found.high)
        assert found.share == pytest.approx(shares[0])


def test_the_command_prints_bands_and_what_persistence_is_worth(commands, tmp_path):
    from riserstudy.seas.record import write_record

    record = synthetic(5, 3)
    write_record(record, tmp_path / "sea.nc")
    asked = ["downtime", tmp_path / "sea.nc", "--limit", "hs <= 2 m", "--next", "5"]
    code, out, err = commands(*asked)
    assert code == 0, err
    found = hours(record, [sea_limit("hs <= 2 m")])
    of = found.next_years(5)
    assert f"next 5 years: {of.share:.2%} ({of.low:.2%} to {of.high:.2%} with 90 % probability)" in out
    assert "persistence of years 0.66" in out
    persistent = commands(*asked, "--persistence", "0.9")[1]
    wide = found.next_years(5, 0.9)
    assert f"({wide.low:.2%} to {wide.high:.2%} with 90 % probability)" in persistent
    assert wide.high - wide.low > of.high - of.low
    assert commands(*asked, "--persistence", "1.2")[0] == 2


def test_a_study_refuses_an_exponent_that_no_noise_has():
    from riserstudy.inputs.validate import check
    from riserstudy.study.seas_model import SeasModel

    fields = {"scene": "a.yaml", "caption": "b", "record": {"years": 5, "seed": 1}}
    for exponent in (0.2, 1.0):
        with pytest.raises(InputError, match="persistence"):
            check(SeasModel, fields | {"persistence": exponent}, "mine")
