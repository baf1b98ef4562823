"""Colours and marks of the chapter: one meaning each."""

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from chapters.liu2017.figures.shared import OF_HEADING, STROKE_OUT, mark_stroke_out
from chapters.liu2017.limits import LIMITS
from riserstudy.figures.style import COLOURS

APART = 0.2  # least distance of two colours, of 1.7 from black to white


def test_headings_have_colours_that_no_limit_has():
    colours = [*OF_HEADING.values(), *COLOURS[: len(LIMITS) + 1]]  # the sixth: of the riser
    for k, one in enumerate(colours):
        for other in colours[k + 1 :]:
            assert np.linalg.norm(np.subtract(to_rgb(one), to_rgb(other))) >= APART, (one, other)


def test_stroke_out_is_named_once_in_a_panel():
    ax = Figure().subplots()
    for place in (1.0, 2.0, 3.0):
        mark = mark_stroke_out(ax, place, 0.5)
        assert mark.get_marker() == "x"
    assert ax.get_legend_handles_labels()[1] == [STROKE_OUT]
