"""Peaks between time steps: of fourth order where values are smooth, and not above a sudden drop."""

import numpy as np
import pytest

from riserstudy.simulation.step_peaks import peaks_of


def peak(time, values):
    return peaks_of(time, {"one": values})["one"]


def steps(random, count):
    """Times of steps that differ by up to a factor of three."""
    return np.concatenate([[0.0], np.cumsum(random.uniform(0.5, 1.5, count))]) * 10.0 / count


@pytest.mark.parametrize("seed", range(20))
def test_a_sudden_drop_or_rise_has_no_peak_above_the_values_before_it(seed):
    random = np.random.default_rng(seed)
    time = steps(random, 60)
    level, drop = random.normal(), random.uniform(0.5, 5.0)
    slow = 1e-3 * np.sin(random.uniform(0.2, 0.6) * time)
    values = level + slow - drop * (time > random.uniform(2.0, 8.0))
    found = peak(time, values)
    # the small motion may itself have a peak between steps
    assert found.largest - values.max() < 1e-4
    assert values.min() - found.smallest < 1e-4


@pytest.mark.parametrize("seed", range(5))
def test_smooth_peaks_are_of_fourth_order_on_even_steps(seed):
    random = np.random.default_rng(seed)
    rate, worst = random.uniform(0.5, 1.0), []
    for count in (40, 80, 160):
        time = np.linspace(0.0, 20.0, count + 1)
        found = [peak(time, np.sin(rate * time + p)) for p in random.uniform(0.0, 2 * np.pi, 200)]
        worst.append(max(max(abs(one.largest - 1.0), abs(one.smallest + 1.0)) for one in found))
    # the third derivative over 6, times v (1 - v) (2 - v) with v up to a half: 0.04
    assert worst[0] < 0.04 * (rate * 0.5) ** 4
    assert worst[0] / worst[1] > 12.0
    assert worst[1] / worst[2] > 12.0


def test_an_event_with_two_values_at_one_time_is_not_smoothed():
    time = np.array([0.0, 1.0, 2.0, 2.0, 3.0, 4.0])
    found = peak(time, np.array([1.0, 1.1, 1.15, -4.0, -4.0, -4.1]))
    assert (found.largest, found.smallest) == (1.15, -4.1)
