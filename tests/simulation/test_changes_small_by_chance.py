"""An error of two orders with opposite signs: its last change can be small by chance."""

import numpy as np
import pytest

from riserstudy.scene.limits import OF_ONE_PLACE
from riserstudy.simulation.remaining_error import LEAST_FALL, MOST_FALL, estimate

COVERED = 2.3  # true over estimated error; where a change decreases as by second order, nothing shows more


def changes_of(second, third):
    """Last change, the change before, and the remaining error, by halvings of a mesh from 1 to a quarter."""
    coarse, middle, fine = (second * h**2 + third * h**3 for h in (1.0, 0.5, 0.25))
    return abs(fine - middle), abs(middle - coarse), abs(fine)


@pytest.mark.parametrize("name", OF_ONE_PLACE)
@pytest.mark.parametrize("seed", range(30))
def test_an_estimate_at_one_place_covers_an_error_whose_change_is_small_by_chance(name, seed):
    """Also if its change decreases by four to twenty, as by an order that the method does not have."""
    draw = np.random.default_rng(seed)
    for third in draw.uniform(-1.6, 1.6, 200).tolist():
        last, before, true = changes_of(1.0, third)
        error = estimate({name: last}, {name: before})[name]
        assert true <= COVERED * error
        assert error <= max(2.0 / (MOST_FALL - 1.0), 1.0 / (LEAST_FALL - 1.0)) * last


def test_errors_of_many_places_are_not_small_by_chance():
    """The largest of many changes is not: its estimate is that of second order."""
    for name in ("displacement", "tension", "moment"):
        assert estimate({name: 0.1}, {name: 0.8})[name] == pytest.approx(0.1 / 3.0)
