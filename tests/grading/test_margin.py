"""How far claims are from where they would turn."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.grading.grade import Found, graded, judged
from riserstudy.grading.margin import above, below, everywhere, least, rising
from riserstudy.grading.models import Item
from riserstudy.records.graded import Share


def steps(*values):
    return xr.DataArray(list(values), dims="speed", coords={"speed": range(len(values))})


@pytest.mark.parametrize(
    "value, bound, margin",
    [
        (2.0, 1.0, 0.5),  # a factor of two, either way
        (1.0, 2.0, -0.5),
        (1.0, 1.0, 0.0),
        (0.0, 0.0, 0.0),
        (-1.0, 1.0, -2.0),
        (np.inf, 1.0, 1.0),
        (1.0, np.inf, -1.0),
        (np.inf, np.inf, 0.0),  # two that never come
        (-np.inf, -np.inf, 0.0),
        (np.inf, -np.inf, 1.0),
    ],
)
def test_a_margin_is_the_difference_over_the_larger_of_both(value, bound, margin):
    assert float(above(value, bound)) == margin
    assert float(below(bound, value)) == margin


@pytest.mark.parametrize("value, bound", [(np.nan, 1.0), (1.0, np.nan), (np.nan, np.inf)])
def test_what_is_not_a_number_has_no_margin(value, bound):
    assert bool(above(value, bound).isnull())
    assert bool(below(value, bound).isnull())


def test_where_the_bound_is_zero_a_size_is_given():
    assert float(above(3.0, 0.0, over=12.0)) == 0.25
    assert float(below(3.0, 0.0, over=12.0)) == -0.25


def test_values_rise_by_the_least_of_their_steps():
    assert float(rising(steps(1.0, 2.0, 2.5), "speed")) == pytest.approx(0.2)
    assert float(rising(steps(1.0, 2.0, 2.5), "speed", -1.0)) == -0.5
    assert float(rising(steps(1.0, 2.0, 1.5), "speed")) == -0.25


def test_a_gap_along_an_axis_is_no_rise():
    assert not bool(rising(steps(1.0, np.nan, 2.0), "speed") > 0.0)
    assert not bool(everywhere(steps(1.0, np.nan), "speed") > 0.0)


def test_of_several_conditions_the_least_counts_and_a_missing_one_is_not_met():
    one, other = steps(0.1, 0.3, np.nan), steps(0.2, -0.1, 0.4)
    assert least(one, other).values.tolist()[:2] == [0.1, -0.1]
    assert (least(one, other) > 0.0).values.tolist() == [True, False, False]


ITEM = {"id": "X1", "figure": "1", "statement": "invented", "reads": {"runs": "base"}}


def checks(name):
    """Checks of an invented paper: its quantity, and whether it is at least two."""
    both = {
        "number": lambda runs: Found(runs["quantity"]),
        "claim": lambda runs: judged(runs["quantity"], above(runs["quantity"], 2.0)),
        "plain": lambda runs: Found(runs["quantity"], runs["quantity"] >= 2.0),
    }
    return both[name]


def runs(*values):
    return xr.Dataset({"quantity": ("sample", list(values))}, {"sample": range(len(values))})


def graded_over(*values, **about):
    base = runs(4.0).isel(sample=0)
    item = Item(**ITEM, over={"runs": "space"}, **about)
    return graded("paper", item, checks, {"base": base, "space": runs(*values)})


def test_a_claim_tells_the_margin_of_its_base_and_of_each_sample():
    found = graded_over(1.0, 2.5, 4.0, 8.0, kind="claim", check="claim")
    assert found.margin == 0.5
    base, *cases = found.cases
    assert (base.base, base.judged, base.margin) == (True, False, 0.5)
    assert [(one.place, one.margin) for one in cases] == [
        ({"sample": 0}, -0.5), ({"sample": 1}, 0.2), ({"sample": 2}, 0.5), ({"sample": 3}, 0.75)
    ]  # fmt: skip
    assert [one.met for one in cases] == [one.margin > 0.0 for one in cases]
    true = np.mean([one.met for one in cases])
    assert found.grounds.share == Share(round(4 * true), 4, 4)
    assert -0.5 < found.margin_low < found.margin_high < 0.75


def test_a_number_has_room_within_its_tolerance():
    found = graded_over(4.0, 4.1, 4.5, kind="number", check="number", published=4.0, rounding=0.2)
    assert found.margin == 1.0
    assert [one.margin for one in found.cases] == pytest.approx([1.0, 1.0, 0.0, -0.8])
    assert [one.met for one in found.cases] == [True, True, True, False]


def test_a_check_that_says_true_or_false_alone_has_no_margin():
    found = graded_over(1.0, 4.0, kind="claim", check="plain")
    assert (found.margin, found.margin_low) == (None, None)
    assert [(one.met, one.margin) for one in found.cases] == [
        (True, None), (False, None), (True, None)
    ]  # fmt: skip
