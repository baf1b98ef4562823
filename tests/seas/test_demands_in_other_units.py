"""A demand of several seeds is in the unit of its output, from any zero, and has a NaN if a seed has it."""

import math

import numpy as np
import pytest

from riserstudy.dataset.statistics import FEWEST_SEEDS
from riserstudy.errors import InputError
from riserstudy.study.demand_in_sea import check_seeds, demand

SIDES = ("largest", "smallest", "mean")


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("seed", range(8))
def test_a_demand_follows_a_change_of_unit_and_of_zero(seed, side):
    """Also where the seeds differ little beside their mean, such as tensions in a calm sea."""
    draw = np.random.default_rng(seed)
    values, runs = draw.gumbel(0.0, 1.0, int(draw.integers(5, 20))), float(draw.uniform(0.5, 20.0))
    unit, zero = 10.0 ** draw.uniform(-6.0, 6.0), 10.0 ** draw.uniform(1.0, 5.0) * draw.choice([-1.0, 1.0])
    one, other = demand(values, side, runs), demand(unit * (zero + values), side, runs)
    assert other.value / unit - zero == pytest.approx(one.value, abs=1e-5)
    assert other.deviation / unit == pytest.approx(one.deviation, rel=1e-5)
    assert other.scale / unit == pytest.approx(one.scale, rel=1e-5)
    assert (one.scale == 0.0) == (side == "mean")


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("seed", range(4))
def test_a_seed_without_a_value_leaves_no_demand(seed, side):
    draw = np.random.default_rng(seed)
    values = draw.gumbel(5.0, 1.0, 9)
    values[draw.integers(9)] = math.nan
    assert math.isnan(demand(values, side, 3.0).value)


def test_the_number_of_seeds_is_one_or_enough_for_a_distribution():
    for seeds in range(1, 30):
        if seeds == 1 or seeds >= FEWEST_SEEDS:
            check_seeds(seeds)
        else:
            with pytest.raises(InputError, match=f"{seeds} runs are too few"):
                check_seeds(seeds)
