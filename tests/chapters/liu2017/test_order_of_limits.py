"""Which limit is first: judged in every run that reaches one, whether or not its own joint ever does."""

import numpy as np
import pytest
import xarray as xr

from chapters.liu2017.claims import stroke_begins_before_the_bottom, stroke_responds_fast, ufj_first
from chapters.liu2017.limits import BOTTOM, LIMITS, START
from riserstudy.grading.word_of_size import Word

TIME = np.linspace(0.0, 150.0, 601)
OBVIOUS = Word("obvious", 0.05, False, 0.02)


def drawn(seed, count=40):
    """Runs whose shares of all limits grow evenly, and when each limit would be reached (limit, sample)."""
    draw = np.random.default_rng(seed)
    times = draw.uniform(20.0, 400.0, (len(LIMITS), count))
    signs = draw.choice([-1.0, 1.0], times.shape)
    runs = {
        limit.variable: (("sample", "time"), limit.most * (sign / time)[:, None] * TIME)
        for limit, time, sign in zip(LIMITS.values(), times, signs, strict=True)
    }
    return xr.Dataset(runs, {"time": TIME, "sample": np.arange(count)}), dict(zip(LIMITS, times, strict=True))


@pytest.mark.parametrize("seed", range(12))
def test_a_run_in_which_another_limit_is_reached_counts_against_the_upper_flex_joint(seed):
    runs, times = drawn(seed)
    found = ufj_first(runs)
    ufj = times["upper flex joint"]
    others = np.min([time for name, time in times.items() if name != "upper flex joint"], axis=0)
    assert (found.given.values == (np.minimum(ufj, others) <= TIME[-1])).all()
    judged = found.given.values
    assert (found.true.values == (ufj < others))[judged].all()
    # shares grow evenly: their ratio is the inverse ratio of the times
    assert found.value.values[judged] == pytest.approx((others / ufj)[judged], rel=1e-6)


@pytest.mark.parametrize("seed", range(12))
def test_the_stroke_is_compared_with_the_fastest_part_at_the_bottom(seed):
    runs, times = drawn(seed)
    low, stroke = np.min([times[name] for name in BOTTOM], axis=0), times["telescopic joint"]
    found = stroke_responds_fast(runs, OBVIOUS)
    assert found.value.values == pytest.approx(low / stroke, rel=1e-6)
    assert (found.true.values == (1.0 - stroke / low >= OBVIOUS.bound)).all()
    begins = stroke_begins_before_the_bottom(runs)
    assert begins.value.values == pytest.approx(START * (low - stroke), abs=1e-6)
    assert (begins.true.values == (stroke < low)).all()
