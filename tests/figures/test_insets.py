"""Enlarged parts of panels."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from riserstudy.figures.insets import close_up


@pytest.mark.parametrize("seed", range(10))
def test_crests_between_outputs_are_those_of_the_record(seed):
    """Of sines with 20 outputs a period, whose crests lie between outputs."""
    random = np.random.default_rng(seed)
    ax = Figure().subplots()
    t = np.arange(0.0, 130.1, 0.5)
    amplitudes, phases = random.uniform(0.5, 3.0, 3), random.uniform(0.0, 2.0 * np.pi, 3)
    for amplitude, phase in zip(amplitudes, phases, strict=True):
        ax.plot(t, amplitude * np.sin(0.2 * np.pi * t + phase))
    close_up(ax)
    (inset,) = ax.child_axes
    for line, amplitude in zip(inset.lines, amplitudes, strict=True):
        assert line.get_ydata().max() == pytest.approx(amplitude, rel=5e-4)
    low, high = inset.get_ylim()
    assert low < amplitudes.min() < amplitudes.max() < high
