"""Marks of a logarithmic axis whose ends have a small ratio."""

import numpy as np
import pytest
from figure_rules import assert_ticks_apart
from matplotlib.backends.backend_agg import FigureCanvasAgg

from riserstudy.figures.style import log_ticks, panels


@pytest.mark.parametrize("seed", range(9))
def test_a_short_axis_has_at_least_two_marks_that_are_apart_or_three_if_it_is_longer(seed):
    """Evenly spaced marks were two at the right of an axis, or met at its upper end."""
    draw = np.random.default_rng(seed)
    for ratio in (draw.uniform(1.15, 3.0), draw.uniform(3.0, 4.0)):
        figure, (ax, _) = panels(1, 2, 3.3)
        low = 10.0 ** draw.uniform(-4.0, 3.0)
        ax.plot([low, ratio * low], [1.0, 2.0])
        ax.set_title("marks")
        ax.set_xscale("log")
        ax.set_xlim(low, ratio * low)
        log_ticks(ax.xaxis)
        ax.xaxis.set_major_formatter("{x:.4g}")
        FigureCanvasAgg(figure).draw()
        marks = [mark for mark in ax.get_xticks() if low <= mark <= ratio * low]
        assert len(marks) >= (3 if ratio >= 3.0 else 2), (low, ratio)
        assert_ticks_apart(figure)
