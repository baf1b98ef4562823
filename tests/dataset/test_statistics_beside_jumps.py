"""Statistics of a record that changes suddenly, as the pull of a cylinder that fails."""

import numpy as np
import pytest

from riserstudy.dataset.statistics import extremes


@pytest.mark.parametrize("seed", range(40))
def test_nothing_exceeds_a_record_beside_a_sudden_change(seed):
    """Slow motion before and after, of up to a hundredth of the change."""
    draw = np.random.default_rng(seed)
    count = int(draw.integers(40, 200))
    at = int(draw.integers(10, count - 10))
    slow = 0.01 * draw.uniform() * np.sin(2.0 * np.pi * np.arange(count) / draw.uniform(20.0, 60.0))
    record = draw.choice([-1.0, 1.0]) * (slow + (np.arange(count) >= at))
    (least,), (most,) = extremes(record[None])
    # a parabola through three outputs of the slow motion exceeds them by less than an eighth of its bend
    assert record.min() - 2e-4 <= least <= record.min()
    assert record.max() <= most <= record.max() + 2e-4


@pytest.mark.parametrize("seed", range(20))
def test_a_sine_with_four_outputs_in_a_period_or_more_has_its_amplitude(seed):
    draw = np.random.default_rng(seed)
    phase, outputs = draw.uniform(0.0, 2.0 * np.pi), draw.uniform(5.0, 30.0)
    record = np.sin(2.0 * np.pi * np.arange(300) / outputs + phase)
    (least,), (most,) = extremes(record[None])
    assert most == pytest.approx(1.0, abs=0.01)
    assert least == pytest.approx(-1.0, abs=0.01)
