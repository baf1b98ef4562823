"""Demands of few seeds: shares of hours have no bias, but more than one in ten hours exceed a demand."""

import math

import numpy as np
import pytest

from riserstudy.dataset.statistics import gumbel
from riserstudy.study.demand_in_sea import demand, exceeded_on_average

CASES = [(5, 6.0), (5, 1.0), (8, 18.0)]


def drawn(draw, seeds, count):
    """Extremes of runs, (count, seeds)."""
    return draw.gumbel(size=(count, seeds))


@pytest.mark.parametrize("seeds, runs", CASES)
def test_the_average_share_that_exceeds_a_demand_is_that_of_drawn_hours(seeds, runs):
    """Each hour as the largest of its runs, 40 hours for each demand; more than one in ten exceed it."""
    draw, count = np.random.default_rng(seeds), 1200
    demands = np.array([demand(one, "largest", runs).value for one in drawn(draw, seeds, count)])
    hours = draw.gumbel(size=(count, 40, int(runs))).max(axis=2)
    over = (hours > demands[:, None]).mean(axis=1)
    # four standard errors of the mean, which the scatter from demand to demand decides
    allowed = 4.0 * over.std() / math.sqrt(count)
    found = exceeded_on_average(runs, seeds)
    assert over.mean() == pytest.approx(found, abs=allowed)
    assert found - 0.1 > allowed


def test_many_seeds_leave_one_in_ten():
    found = [exceeded_on_average(6.0, seeds) for seeds in (5, 10, 50, 100, 200, 10**6)]
    assert sorted(found, reverse=True) == found
    assert found[-1] == pytest.approx(0.1, abs=1e-5)


@pytest.mark.long
@pytest.mark.parametrize("seeds, runs", CASES)
def test_shares_of_hours_are_without_bias_by_demands_and_too_small_by_a_value_exceeded_less_often(
    seeds, runs
):
    """Sea states of any height, of which those count whose true demand is allowed."""
    draw, count = np.random.default_rng(seeds + 1), 1200
    height = draw.uniform(13.0, 27.0, count)  # mode of the extremes, in their scale
    above = math.log(runs) - math.log(-math.log(0.9))
    allowed = 20.0 + above
    each = drawn(draw, seeds, count)
    demands = height + np.array([demand(one, "largest", runs).value for one in each])
    off = (demands <= allowed).astype(float) - (height + above <= allowed)
    error = off.std() / math.sqrt(count)
    assert abs(off.mean()) <= 3.0 * error
    # a value that one in ten further hours exceed on average is higher, and so leaves too few hours
    safe = height + np.array([gumbel(one, runs).fractile for one in each])
    fewer = (safe <= allowed).astype(float) - (height + above <= allowed)
    assert fewer.mean() < -3.0 * fewer.std() / math.sqrt(count)
