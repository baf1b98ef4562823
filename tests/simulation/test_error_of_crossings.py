"""The error of a time between outputs, against the exact times of histories that bend."""

import numpy as np
import pytest

from riserstudy.simulation.first_reached import _error


@pytest.mark.parametrize("bent", [0.0, 1.0])
@pytest.mark.parametrize("seed", range(20))
def test_the_error_is_the_largest_of_all_levels_between_two_outputs(seed, bent):
    """Of parabolas by a tenth; if the curvature itself changes, it is at least the largest error."""
    draw = np.random.default_rng(seed)
    times = np.arange(9) * draw.uniform(0.1, 2.0)
    step, at = times[1], draw.uniform(-1.0, 1.0, 2)
    k, sign = int(draw.integers(1 + bent, 9 - bent)), draw.choice([-1.0, 1.0])

    def history(t):
        x = t / step - k + 0.5
        return sign * (20.0 + 3.0 * x + 0.4 * at[0] * x**2 + bent * 0.05 * at[1] * x**3)

    dense = np.linspace(times[k - 1], times[k], 2001)
    values = history(dense)
    straight = np.interp(dense, times, history(times))
    by_level = abs(np.interp(sign * straight, sign * values, dense) - dense)
    found = _error(times, history(times), float(dense[700]))
    if bent:
        assert found >= 0.9 * by_level.max()
    else:
        assert found == pytest.approx(by_level.max(), rel=0.1)
    assert found <= step


def test_without_a_crossing_or_a_curvature_there_is_no_error():
    times, values = np.arange(5.0), np.arange(5.0) ** 2
    assert _error(times, values, 0.0) == 0.0
    assert _error(times, values, np.inf) == 0.0
    assert _error(times[:2], values[:2], 0.5) == 0.0
    assert _error(times, np.array([0.0, 0.0, 1.0, 1.0, 0.0]), 2.5) == 1.0  # the whole step
