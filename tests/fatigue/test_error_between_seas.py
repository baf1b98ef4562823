"""Estimated error of damage between simulated seas near a resonance, against the simulated function."""

import numpy as np
import pytest
from test_years import study

from riserstudy.fatigue.occurrence import Occurrence
from riserstudy.fatigue.years import over_years


def drawn(draw):
    """A resonant stress to a power, simulated over an uneven grid of seas, and a record of seas."""
    power, at, wide, floor = draw.uniform((3.0, 5.0, 1.5, 0.02), (5.5, 14.0, 6.0, 0.3))

    def by(height, period, _):
        return 1e-4 * (height * (floor + 1.0 / (1.0 + ((period - at) / wide) ** 2))) ** power

    heights = np.arange(0.5, draw.uniform(7.0, 11.0), draw.choice([0.5, 1.0, 1.5, 2.0]))
    periods = np.arange(4.0, 19.0, draw.choice([1.0, 1.5, 2.0, 3.0]))
    grids = [
        np.sort([g[0], g[-1], *(g[1:-1] + draw.uniform(-0.15, 0.15, len(g) - 2))]) for g in (heights, periods)
    ]
    hs = np.clip(1.8 * np.exp(0.5 * draw.standard_normal(400)), heights[0], heights[-1])
    tp = np.clip(7.2 * hs**0.32 * np.exp(0.12 * draw.standard_normal(400)), periods[0], periods[-1])
    return by, grids, hs, tp


def errors(draw):
    """True relative error of the largest damage, with its sign, and its estimate."""
    by, grids, hs, tp = drawn(draw)
    occurs = Occurrence({"significant_height": hs, "peak_period": tp}, np.full(len(hs), 1.0 / len(hs)), ())
    found = over_years(study(0.0, *grids, by=by), occurs, {}).worst[0]
    return found.rate / by(hs, tp, 0.0).mean() - 1.0, found.error_between


@pytest.mark.parametrize("seed", range(3))
def test_the_estimate_covers_errors_near_a_resonance(seed):
    """A difference between grids hides errors where it changes its sign, from sea to sea or by omission."""
    draw = np.random.default_rng((seed, 50))
    signed, told = np.transpose([errors(draw) for _ in range(60)])
    # linear interpolation of the fourth root gives 4 to 5 % too little damage in the median
    assert abs(np.median(signed)) <= 0.02
    off = abs(signed)
    assert (off <= 3.0 * told + 1e-3).all()  # a grid far too coarse for the resonance does not show it
    assert (off <= told).mean() >= 0.85
    assert (told[off > 0.01] <= 10.0 * off[off > 0.01]).mean() > 0.7  # nor is it far too large


@pytest.mark.parametrize("seed", range(6))
def test_an_axis_without_interpolation_adds_no_error(seed):
    """Heights that are simulated, with any periods between: however few or unequal the heights."""
    draw = np.random.default_rng((seed, 51))
    by, (_, periods), _, tp = drawn(draw)
    heights = np.sort(draw.uniform(1.0, 12.0, draw.integers(2, 9)))
    hs = draw.choice(heights, len(tp))
    of = study(0.0, heights, periods, by=by)
    shares = np.full(len(hs), 1.0 / len(hs))
    found = over_years(of, Occurrence({"significant_height": hs, "peak_period": tp}, shares, ()), {}).worst[0]
    each = [
        over_years(
            of.sel(significant_height=[height]),
            Occurrence({"peak_period": tp[hs == height]}, shares[hs == height], ()),
            {},
        ).worst[0]
        for height in np.unique(hs)
    ]
    apart = sum(one.rate * one.error_between for one in each) / found.rate
    assert found.error_between == pytest.approx(apart, rel=1e-9)
