"""The lag of two series: against a search one by one, and on long records."""

import time

import numpy as np
import pytest

from riserstudy.dataset.lag import _left, lag


def record(rng, n):
    """A smooth random series about a mean of its own."""
    rough = rng.normal(size=n + 40)
    return 1e6 * rng.uniform(-1, 1) + 1e4 * np.convolve(rough, np.hanning(41), "valid")[:n]


@pytest.mark.parametrize("seed", range(12))
def test_what_is_left_is_that_of_every_shift_alone(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(5, 400))
    a, b = record(rng, n), record(rng, n)
    half = n // 4
    known = np.ones(n, bool) if seed % 2 else rng.random(n) < 0.8
    known[: n // 2 + 1] = True  # shifts with few values in common are not compared
    values = np.where(known, a, np.nan), np.where(known, b, np.nan)
    one_by_one = [
        np.nanvar(values[0][max(k, 0) : n + min(k, 0)] - values[1][max(-k, 0) : n - max(k, 0)])
        for k in range(-half, half + 1)
    ]
    # rounding, of squares about the mean of both
    off = np.abs(_left(a, b, known) - one_by_one).max()
    assert off < 1e-10 * (np.var(np.concatenate([a, b])) + 1.0)


@pytest.mark.parametrize("seed", range(6))
def test_a_long_record_is_searched_in_seconds(seed):
    """400 000 values, delayed by a whole number of steps: an hour of search one by one."""
    rng = np.random.default_rng(seed)
    n, late = 400_000, int(rng.integers(-90_000, 90_000))
    whole = record(rng, n + 100_000)
    start = max(late, 0)
    ours, theirs = whole[start - late :][:n], whole[start:][:n]
    began = time.process_time()
    found, left = lag(0.1 * np.arange(n), ours, theirs)
    assert found == pytest.approx(0.1 * late, abs=1e-3)
    assert left < 1e-6 * np.std(theirs)
    assert time.process_time() - began < 20.0


@pytest.mark.long
def test_times_that_are_close_together_once_do_not_fill_the_memory():
    along = np.append(np.arange(0.0, 1000.0, 0.5), 999.5 + 1e-9)
    found, _ = lag(along, np.sin(along), np.sin(along + 1.0))
    assert found == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("seed", range(12))
def test_a_lag_beyond_the_search_is_unknown(seed):
    draw = np.random.default_rng(seed)
    along, late = 0.1 * np.arange(1000), float(draw.uniform(25.5, 29.0)) * draw.choice([-1.0, 1.0])

    def pulse(t):  # wide enough to be felt at the end of the search
        return np.exp(-(((t - 50.0) / 12.0) ** 2))

    assert np.isnan(lag(along, pulse(along - late), pulse(along))).all()
    within = 0.5 * late
    assert lag(along, pulse(along - within), pulse(along))[0] == pytest.approx(within, abs=0.05)
