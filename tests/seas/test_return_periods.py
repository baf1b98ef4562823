"""Return periods mean one thing: in a year, a return value is exceeded with a probability of 1 / period."""

import math

import numpy as np
import pytest
from scipy.stats import genpareto

from riserstudy.seas.return_values import drawn_of_peaks, drawn_of_years, return_values, storms
from riserstudy.seas.synthetic import synthetic

YEARS = 4000
DEVIATIONS = 4.0  # of a share of so many years; the fit to their storms is nearly exact


def of_seed(seed):
    """Peaks of storms at random times in many years, over a threshold, and the highest of each year."""
    draw = np.random.default_rng(seed)
    number = draw.poisson(draw.uniform(4.0, 9.0), YEARS)
    shape, scale, threshold = draw.uniform(-0.25, 0.15), draw.uniform(0.3, 3.0), draw.uniform(1.0, 9.0)
    peaks = threshold + scale * genpareto.rvs(shape, size=number.sum(), random_state=draw)
    each = np.split(peaks, np.cumsum(number)[:-1])
    return draw, peaks, threshold, np.array([one.max(initial=threshold) for one in each])


@pytest.mark.parametrize("period", [2.0, 3.0, 10.0])
@pytest.mark.parametrize("seed", range(8))
def test_one_year_in_a_return_period_exceeds_the_value_from_storms(seed, period):
    """Not one storm: of two years, one may have two storms above the value, and the other none."""
    draw, peaks, threshold, largest = of_seed(seed)
    value, _ = drawn_of_peaks(peaks, threshold, float(YEARS), period, draw, 1)
    chance = 1.0 / period
    allowed = DEVIATIONS * math.sqrt(chance * (1.0 - chance) / YEARS)
    assert (largest > value).mean() == pytest.approx(chance, abs=allowed)


@pytest.mark.parametrize("seed", range(8))
def test_both_methods_give_one_value_where_both_distributions_are_true(seed):
    """Exponential peaks at random times make yearly maxima of a Gumbel distribution."""
    draw = np.random.default_rng(seed)
    number, scale = draw.poisson(draw.uniform(6.0, 9.0), YEARS), draw.uniform(0.3, 3.0)
    peaks = 5.0 + draw.exponential(scale, number.sum())
    largest = np.array([one.max(initial=5.0) for one in np.split(peaks, np.cumsum(number)[:-1])])
    for period in (2.0, 5.0, 50.0):
        years, _ = drawn_of_years(largest, period, draw, 1)
        by_storms, _ = drawn_of_peaks(peaks, 5.0, float(YEARS), period, draw, 1)
        # the scales of both fits have errors of 2 %, and values are up to seven scales above the threshold
        assert by_storms == pytest.approx(years, abs=0.04 * scale * (2.0 + math.log(period)))


@pytest.mark.parametrize("seed", range(6))
def test_years_that_a_record_lacks_change_no_storm(seed):
    """Number and threshold of storms are those of the recorded time, wherever its gap is."""
    draw = np.random.default_rng(seed)
    record = synthetic(int(draw.integers(6, 9)), seed)
    time, height = record["time"].values, record["significant_wave_height"].values.copy()
    years = time.astype("datetime64[Y]").astype(int) + 1970
    first = int(draw.integers(2003, 2006))  # of the part after the gap
    height[np.abs(time - np.datetime64(f"{first}-01-01")) < np.timedelta64(5, "D")] = np.nan
    leap_years = int(draw.integers(1, 4))
    later = np.where(years >= first, leap_years * np.timedelta64(1461, "D"), np.timedelta64(0, "D"))
    apart = time + later
    for one, another in zip(storms(time, height, 6.0), storms(apart, height, 6.0), strict=True):
        np.testing.assert_array_equal(one, another)
    tables = [return_values(of, height, 1.0, [2.0, 50.0]).rows for of in (time, apart)]
    assert tables[0] == tables[1]


def test_the_commands_print_the_definition(commands):
    code, out, _ = commands("seas", "--synthetic", "6", "--return-period", "20")
    assert (code, "exceeded in a year with a probability of 1 / return period" in out) == (0, True)
