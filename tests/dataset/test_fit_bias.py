"""Demands by extremes of few seeds, on average over many sets of seeds, against the distribution itself."""

import math

import numpy as np
import pytest

from riserstudy.dataset.fit_bias import bias_of, error_of, error_of_scale
from riserstudy.dataset.statistics import gumbel
from riserstudy.study.demand_in_sea import demand

MODE, SCALE = 8.0, 1.5
SETS = 1500  # of seeds: the mean of their scales has an error of 1 % for five seeds


def sets_of(seed, count):
    return np.random.default_rng((seed, count)).gumbel(MODE, SCALE, (SETS, count))


@pytest.mark.parametrize("side, sign", [("largest", 1.0), ("smallest", -1.0)])
@pytest.mark.parametrize("runs", [1.0, 6.0, 18.0])
@pytest.mark.parametrize("count", [5, 8, 20])
def test_demands_by_few_seeds_are_on_average_those_of_nine_in_ten_intervals(count, runs, side, sign):
    """The largest of r runs exceeds x with the probability 1 - F(x)^r, which is one in ten at the demand."""
    found = [demand(sign * values, side, runs) for values in sets_of(7, count)]
    values, told, scales = (np.array([one[k] for one in found]) for k in range(3))
    over = MODE - SCALE * math.log(-math.log(0.9) / runs)
    chance = 4.0 / math.sqrt(SETS)
    assert sign * values.mean() == pytest.approx(over, abs=chance * values.std() + 0.01 * SCALE)
    assert scales.mean() == pytest.approx(SCALE, abs=chance * scales.std() + 0.003 * SCALE)
    # the deviation of 1500 values with long tails has an error of some per cent
    assert told.mean() == pytest.approx(values.std(), rel=0.1)


@pytest.mark.parametrize("count", [5, 8, 20])
def test_mode_and_scale_of_few_seeds_are_on_average_those_of_the_distribution(count):
    """The scale by maximum likelihood of five seeds is 16 % too small on average."""
    found = [gumbel(values) for values in sets_of(8, count)]
    modes, scales, fractiles, told = np.transpose(found)
    chance = 4.0 / math.sqrt(SETS)
    assert scales.mean() == pytest.approx(SCALE, abs=chance * scales.std())
    assert modes.mean() == pytest.approx(MODE, abs=chance * modes.std())
    assert told.mean() == pytest.approx(modes.std(), rel=0.08)  # four standard errors of a deviation
    beyond = 1.0 - np.exp(-np.exp(-(fractiles - MODE) / SCALE))
    assert beyond.mean() == pytest.approx(0.1, abs=chance * beyond.std())


@pytest.mark.parametrize("count", [100, 101, 400])
def test_errors_of_many_seeds_are_those_of_maximum_likelihood(count):
    """By its asymptotic variances: Johnson, Kotz and Balakrishnan 1995, chapter 22."""
    assert error_of_scale(count) == pytest.approx(math.sqrt(6.0 / count) / math.pi, rel=0.02)
    for above in (0.0, 2.25, 5.0):
        share = 1.0 + 6.0 / math.pi**2 * (1.0 - np.euler_gamma + above) ** 2
        assert error_of(above, count) == pytest.approx(math.sqrt(share / count), rel=0.02)
    assert abs(bias_of(count).mode) < 0.5 / count
    assert abs(bias_of(count).scale - 1.0) < 1.0 / count
