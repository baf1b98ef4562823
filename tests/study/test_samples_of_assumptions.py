"""Samples of unspecified inputs: an even cover of ranges and options, in their own units."""

from collections import Counter
from types import SimpleNamespace

import numpy as np
import pytest

from riserstudy.errors import InputError
from riserstudy.study.sampling import sample, sobol, value_at


def ranged(low, high):
    return SimpleNamespace(range=(low, high), options=None)


def optional(*options):
    return SimpleNamespace(range=None, options=options)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("count", [8, 64])
def test_every_interval_of_every_input_has_one_of_a_power_of_two_of_points(seed, count):
    """The property of a (t, m, 1) net, by which Sobol's points are defined."""
    points = np.array(sobol(5, count, seed))
    assert points.shape == (count, 5)
    for column in points.T:
        assert sorted((column * count).astype(int)) == list(range(count))
    assert len(np.unique(points.round(12), axis=0)) == count


@pytest.mark.parametrize("count", [2, 5, 13])
def test_fewer_points_are_the_first_of_more(count):
    assert sobol(3, count, 4) == sobol(3, 16, 4)[:count]
    assert sobol(3, count, 4) != sobol(3, count, 5)


@pytest.mark.parametrize(
    "low, high, unit", [("2 m", "6 m", " m"), ("-1.5e3 kN", "5e2 kN", " kN"), (3.0, 5.0, "")]
)
def test_a_range_is_sampled_from_end_to_end_in_its_unit(low, high, unit):
    ends = [float(str(end).split()[0]) for end in (low, high)]
    for x in (0.0, 0.25, 0.5, 0.999):
        text = value_at("top.offset", ranged(low, high), x)
        value = float(str(text).removesuffix(unit))
        # the shares of the range on both sides of the value
        assert (value - ends[0]) * (1.0 - x) == pytest.approx((ends[1] - value) * x)
        assert unit == "" or text.endswith(unit)


def test_options_are_drawn_equally_often_and_ranges_beside_them_evenly():
    assumed = {"a": optional("one", "two", "three", "four"), "b": ranged("0 m", "32 m"), "c": optional(0, 1)}
    drawn = sample(assumed, 32, 7)
    assert Counter(one["a"] for one in drawn) == dict.fromkeys(("one", "two", "three", "four"), 8)
    assert Counter(one["c"] for one in drawn) == {0: 16, 1: 16}
    assert sorted(int(float(one["b"].removesuffix(" m"))) for one in drawn) == list(range(32))


@pytest.mark.parametrize("count", [2, 3, 7])
def test_the_last_option_has_its_share_up_to_the_end(count):
    origin = optional(*range(count))
    drawn = [value_at("p", origin, (k + 0.5) / (10 * count)) for k in range(10 * count)]
    assert Counter(drawn) == dict.fromkeys(range(count), 10)
    assert value_at("p", origin, 1.0) == count - 1


@pytest.mark.parametrize("ends", [("1 m", "2 km"), ("1 m", 2.0), ("few", "many")])
def test_a_range_in_two_units_is_refused(ends):
    with pytest.raises(InputError, match="two values in the same unit"):
        value_at("top.offset", ranged(*ends), 0.5)


def test_samples_without_assumptions_are_refused():
    with pytest.raises(InputError, match="require a scene with assumptions"):
        sample({}, 8, 1)
