"""Gaps at random times hide windows and waits, but change their statistics only by the scatter."""

import numpy as np
import pytest

from riserstudy.seas.synthetic import lasting
from riserstudy.seas.windows import statistics_of, waits, windows

YEARS = 20
RECORDS = 6
SCATTER = 0.04  # of the mean of so many records


def of_seed(seed):
    """Workable hours of a sea without seasons, hours that are recorded, and the length of a window (h)."""
    draw = np.random.default_rng(seed)
    n = YEARS * 8766
    sea = lasting(draw, n, float(draw.uniform(10.0, 30.0)))
    workable = sea <= float(draw.uniform(-0.2, 0.8))
    rows = int(draw.integers(12, 49))
    apart, missing = float(draw.uniform(8.0, 16.0)) * rows, int(draw.integers(1, 2 * rows))
    recorded = np.ones(n, bool)
    at = 0
    while at < n:
        at += 1 + int(draw.exponential(apart))
        recorded[at : at + missing] = False
        at += missing
    return workable, recorded, rows


@pytest.mark.parametrize("group", range(4))
def test_gaps_make_waits_neither_longer_nor_shorter(group):
    off = []
    for seed in range(RECORDS * group, RECORDS * (group + 1)):
        workable, recorded, rows = of_seed(seed)
        whole = statistics_of(waits(workable, np.ones(len(workable) - 1, bool), rows, 1.0))
        joined = np.diff(np.flatnonzero(recorded)) == 1
        found = statistics_of(waits(workable[recorded], joined, rows, 1.0))
        off.append([a / b - 1.0 if b else np.nan for a, b in zip(found[:3], whole[:3], strict=True)])
    assert (np.abs(np.nanmean(off, axis=0)) <= SCATTER).all()


@pytest.mark.parametrize("group", range(4))
def test_gaps_make_shares_of_windows_neither_larger_nor_smaller(group):
    off = []
    for seed in range(RECORDS * group, RECORDS * (group + 1)):
        workable, recorded, rows = of_seed(seed)
        whole = windows(workable, np.ones(len(workable) - 1, bool), rows)
        joined = np.diff(np.flatnonzero(recorded)) == 1
        found = windows(workable[recorded], joined, rows)
        off.append([found.inside / whole.inside - 1.0, found.starts / whole.starts - 1.0])
    assert (np.abs(np.mean(off, axis=0)) <= SCATTER).all()
