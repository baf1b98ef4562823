"""Results with each interpretation of a grid of which some cells are missing, against loops over cells."""

import math
from itertools import combinations, product

import numpy as np
import pytest
import xarray as xr

from riserstudy.grading.found import FALSE, NO_DIFFERENCE, TRUE
from riserstudy.grading.grounds import explained
from riserstudy.grading.readings import readings_of
from riserstudy.records.graded import Grounds, Reading, Share

WORDS = {TRUE: "true", FALSE: "false", NO_DIFFERENCE: "no difference"}
AXES = ("a", "b", "c")


def drawn(draw):
    """Answers that follow from some axes; cells are missing."""
    shape = tuple(int(size) for size in draw.integers(2, 4, 3))
    some = [k for k in range(3) if draw.random() < 0.6] or [int(draw.integers(3))]
    of_some = draw.choice([TRUE, FALSE, NO_DIFFERENCE], tuple(shape[k] for k in some))
    answers = np.zeros(shape)
    for cell in np.ndindex(shape):
        answers[cell] = of_some[tuple(cell[k] for k in some)] if draw.random() < 0.7 else math.nan
    return answers


def deciding_axes(answers):
    """The fewest axes on which cells with different answers always differ."""
    known = [cell for cell in np.ndindex(answers.shape) if not math.isnan(answers[cell])]
    pairs = [(one, other) for one, other in combinations(known, 2) if answers[one] != answers[other]]
    for count in range(1, 4):
        for some in combinations(range(3), count):
            if pairs and all(any(one[k] != other[k] for k in some) for one, other in pairs):
                return some
    return (0, 1, 2)


@pytest.mark.parametrize("seed", range(40))
def test_each_interpretation_with_a_known_cell_has_its_answer(seed):
    answers = drawn(np.random.default_rng(seed))
    if np.isnan(answers).all():
        return
    names = [[f"{axis} {k}" for k in range(size)] for axis, size in zip(AXES, answers.shape, strict=True)]
    found = xr.DataArray(answers, dims=AXES, coords=dict(zip(AXES, names, strict=True)))
    some, expected = deciding_axes(answers), {}
    for cell in product(*(range(size) for size in answers.shape)):
        if not math.isnan(answers[cell]):
            expected[tuple(names[k][cell[k]] for k in some)] = WORDS[answers[cell]]
    readings = readings_of("claim", found, xr.Dataset(), None)
    assert {tuple(one.place.values()): one.answer for one in readings} == expected
    assert all(tuple(one.place) == tuple(AXES[k] for k in some) for one in readings)


@pytest.mark.parametrize("seed", range(40))
def test_what_a_verdict_depends_on_follows_from_the_shares_of_interpretations(seed):
    draw = np.random.default_rng(seed)
    base, count = bool(draw.integers(2)), int(draw.integers(2, 4))
    samples = int(draw.choice([40, 59, 200]))
    hits = draw.choice([0, 0.5, 0.96, 1], count, p=draw.dirichlet([0.3] * 4))
    readings = [
        Reading({"a": f"a {k}", "b": "b"} if seed % 4 else {"a": f"a {k}"},
                "true" if hit > 0.95 else "depends" if hit else "false",
                Share(round(hit * samples), samples, samples))
        for k, hit in enumerate(hits)
    ]  # fmt: skip
    constant = xr.DataArray(np.full(4, FALSE), dims="sample")  # of which nothing decides
    found = explained(Grounds(readings=readings), constant, xr.Dataset(), "depends", base, {"a": "letter"})
    if not any(hits):
        assert found.because == "base case"
    elif all(hits > 0.9):
        assert found.because == ("too few samples" if base and samples == 40 else "base case")
    else:
        assert found.because == "inputs"
        if len({one.answer for one in readings}) == 1:
            assert found.decided_by == []
            return
        assert [one.input for one in found.decided_by] == [*readings[0].place]
        assert found.decided_by[0].name == "letter"
        shares = {} if seed % 4 else {f"a {k}": round(hit * samples) / samples for k, hit in enumerate(hits)}
        assert found.decided_by[0].by_option == pytest.approx(shares)
    assert explained(Grounds(readings=readings), constant, xr.Dataset(), "holds", base, {}).because is None
