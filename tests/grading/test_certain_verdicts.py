"""Numbers of samples after which a verdict is certain, by the distributions of their bounds."""

import numpy as np
import pytest
from scipy.stats import beta

from riserstudy.grading.sequential import certain, decided_after, looks
from riserstudy.grading.verdict import met, tolerance


def bounds(hits, samples):
    """One-sided bounds of a share, each with a confidence of 99 %."""
    low = beta.ppf(0.01, hits, samples - hits + 1) if hits else 0.0
    high = beta.ppf(0.99, hits + 1, samples - hits) if hits < samples else 1.0
    return low, high


@pytest.mark.parametrize("samples", [8, 32, 64, 91, 128])
def test_hits_are_certain_where_their_bounds_leave_one_answer(samples):
    for hits in range(samples + 1):
        low, high = bounds(hits, samples)
        ranges = [(0.0, 0.05), (0.05, 0.95), (0.95, 1.0)]
        assert certain(hits, samples) == any(a <= low and high <= b for a, b in ranges)


@pytest.mark.parametrize("samples", [8, 9, 32, 100, 128, 300, 512, 1000])
def test_numbers_that_are_examined_double_and_then_grow_by_halves(samples):
    """Each is a power of two, or the middle of two powers from 64 on."""
    powers = {2**k for k in range(3, 12)} | {3 * 2**k for k in range(5, 12)}
    assert looks(samples) == [*sorted(one for one in powers if one < samples), samples]


def _range_of(share):
    """Whether a share is almost all, almost none, or neither."""
    return bool(share >= 0.95), bool(share <= 0.05)


@pytest.mark.parametrize("seed", range(12))
def test_the_verdict_of_a_claim_is_decided_by_the_first_number_that_is_certain_of_it(seed):
    draw = np.random.default_rng(seed)
    hits = draw.random(256) < draw.choice([0.0, 0.02, 0.5, 0.98, 1.0])
    expected = None
    for n in (256, 192, 128, 96, 64, 32, 16, 8):
        share = hits[:n].mean()
        low, high = bounds(int(hits[:n].sum()), n)
        sure = low >= 0.95 or high <= 0.05 or (low > 0.05 and high < 0.95)
        if sure and _range_of(share) == _range_of(hits.mean()):
            expected = n
    assert decided_after(hits, "claim", bool(hits.mean() > 0.5)) == expected


@pytest.mark.parametrize("published", [-250.0, -0.5, 0.0, 0.5, 250.0])
def test_a_number_is_met_within_a_hundredth_or_half_of_its_last_digit_on_both_sides(published):
    for rounding in (0.001, 0.1, 10.0):
        bound = max(0.5 * rounding, 0.01 * abs(published))
        assert tolerance(published, rounding) == pytest.approx(bound)
        for share, expected in ((0.999, True), (1.0, True), (1.001, False)):
            for side in (-1.0, 1.0):
                assert bool(met(published + side * share * bound, published, rounding)) == expected
