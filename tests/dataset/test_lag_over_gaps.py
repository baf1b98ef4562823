"""A record with a gap has the lag and the difference of its known parts, not of lines across the gap."""

import numpy as np
import pytest

from riserstudy.dataset.lag import lag

NOISE = 0.2


def record(seed, spacing):
    """Times (s), a motion and its later copy with noise, and the lag (s); times may be uneven."""
    draw = np.random.default_rng((seed, spacing == "even"))
    time = np.arange(0.0, 600.0, 0.25)
    if spacing == "two rates":
        time = np.concatenate([time[time < 200.0], np.arange(200.0, 600.0, 1.0)])
    period, phase, size = (draw.uniform(*span, 6) for span in ((8.0, 14.0), (0.0, 6.0), (0.3, 1.0)))
    delay = float(draw.uniform(-2.0, 2.0))
    ours, theirs = (
        (size * np.sin(2.0 * np.pi * (time - late)[:, np.newaxis] / period + phase)).sum(axis=1)
        for late in (delay, 0.0)
    )
    return draw, time, ours, theirs + NOISE * draw.standard_normal(len(time)), delay


@pytest.mark.parametrize("spacing", ["even", "two rates"])
@pytest.mark.parametrize("gaps", [0, 1, 3])
@pytest.mark.parametrize("seed", range(9))
def test_gaps_change_neither_lag_nor_difference(seed, gaps, spacing):
    draw, time, ours, theirs, delay = record(seed, spacing)
    known = np.ones(len(time), bool)
    for begin in draw.uniform(30.0, 400.0, gaps):
        known &= (time < begin) | (time > begin + draw.uniform(40.0, 120.0))
    found, rms = lag(time[known], ours[known], theirs[known])
    assert found == pytest.approx(delay, abs=0.05)
    # a lag of up to half a step remains; interpolation from 1 s to 0.25 s averages noise
    least = 0.93 if spacing == "even" else 0.7
    assert least * NOISE < rms < 1.15 * NOISE


@pytest.mark.parametrize("seed", range(6))
def test_one_missing_row_is_no_gap(seed):
    draw, time, ours, theirs, _ = record(seed, "even")
    known = np.ones(len(time), bool)
    known[draw.choice(np.arange(1, len(time) - 1), 60, replace=False)] = False
    all_rows, some = lag(time, ours, theirs), lag(time[known], ours[known], theirs[known])
    assert some == pytest.approx(all_rows, abs=0.02)
