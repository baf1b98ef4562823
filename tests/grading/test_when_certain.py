"""A number of samples that settles a verdict settles the verdict of all samples."""

import numpy as np
import pytest
import xarray as xr

from riserstudy.grading.grade import graded, judged
from riserstudy.grading.models import Item
from riserstudy.grading.verdict import verdict_of_claim, verdict_of_number
from riserstudy.grading.verdict_sentences import depends_on, note


def found(kind, hits, base):
    """Grading of a claim, or of the number 1, that some samples meet in their order."""
    values = np.where(np.isnan(hits), np.nan, np.where(hits > 0, 1.0, -1.0))
    datasets = {
        "base": xr.Dataset({"v": ((), 1.0 if base else -1.0)}),
        "open": xr.Dataset({"v": ("sample", values)}, {"sample": np.arange(len(hits))}),
    }
    number = {"published": 1.0, "rounding": 0.1} if kind == "number" else {}
    item = Item(
        id="N1",
        figure="1",
        kind=kind,
        statement="it is so",
        check="check",
        reads={"one": "base"},
        over={"one": "open"},
        **number,
    )

    def check(one):
        return judged(one["v"], one["v"]) if kind == "claim" else one["v"]

    return graded("mine", item, lambda _: check, datasets)


def verdict(kind, hits, base):
    share = float(np.mean(hits))
    if kind == "number":
        return verdict_of_number(base, share, False)
    return verdict_of_claim(share, False, base)


def in_turn(draw):
    """Samples that are alike for a while, as those of a Sobol sequence hardly are."""
    parts = [draw.random(draw.integers(1, 200)) < draw.choice([0.0, 0.02, 0.5, 0.98, 1.0]) for _ in range(3)]
    return np.concatenate([*parts, draw.random(100) < 0.5]).astype(float)


@pytest.mark.parametrize("kind", ["number", "claim"])
@pytest.mark.parametrize("seed", range(20))
def test_the_samples_that_settle_a_verdict_give_the_verdict_of_all(seed, kind):
    draw = np.random.default_rng(seed)
    hits, base = in_turn(draw), bool(draw.integers(2))
    settled = found(kind, hits, base).grounds.settled
    if settled.after is not None:
        assert verdict(kind, hits[: settled.after], base) == verdict(kind, hits, base)


@pytest.mark.parametrize(
    "kind, first, then",
    [("claim", 1.0, [0.0] * 32), ("claim", 0.0, [1.0] * 60), ("number", 0.0, [1.0] + [0.0] * 95)],
)
def test_samples_whose_verdict_later_ones_turn_settle_nothing(kind, first, then):
    hits = np.array([first] * 96 + then)
    one = found(kind, hits, bool(first))
    assert one.verdict == "depends"
    assert one.grounds.settled.after != 96


def test_a_number_that_the_base_case_alone_meets_depends_on_the_base_case():
    one = found("number", np.zeros(64), True)
    assert one.verdict == "depends"
    assert depends_on(one.kind, one.grounds) == "the base case; met in 0 of 64 samples (0 %)"


def test_a_verdict_that_missing_values_could_turn_is_not_settled():
    one = found("claim", np.array([1.0] * 4 + [0.0] * 200 + [np.nan] * 20), False)
    assert depends_on(one.kind, one.grounds).startswith("20 cases without a result")
    assert "settle" not in note(one.kind, one.unit, one.grounds)
