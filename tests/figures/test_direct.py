"""Names of lines beside them: apart, as near as can be, legible."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from scipy.optimize import minimize

from riserstudy.figures.direct import label_ends, label_line, legible, spread
from riserstudy.figures.style import COLOURS, panels

PLACES = st.lists(st.floats(0.0, 1.0, width=32), min_size=1, max_size=9)


@given(PLACES, st.randoms(use_true_random=False))
def test_texts_do_not_overlap_and_keep_their_order(places, random):
    places = np.array(places)
    heights = np.array([random.uniform(0.01, 0.3) for _ in places])
    order = np.argsort(places, kind="stable")
    moved, tall = spread(places, heights)[order], heights[order]
    assert np.all(np.diff(moved) >= 0.5 * (tall[1:] + tall[:-1]) - 1e-9)


@given(PLACES)
def test_places_that_are_apart_stay(places):
    places = np.unique(np.array(places))
    apart = float(np.diff(places).min(initial=1.0))
    heights = np.full(places.shape, apart)
    np.testing.assert_allclose(spread(places, heights), places, atol=1e-7)


@pytest.mark.parametrize("seed", range(5))
def test_places_move_as_little_as_can_be(seed):
    draw = np.random.default_rng(seed)
    places, heights = np.sort(draw.uniform(size=6)), draw.uniform(0.05, 0.25, size=6)
    apart = 0.5 * (heights[1:] + heights[:-1])
    held = [
        {"type": "ineq", "fun": lambda x, k=k: x[k + 1] - x[k] - apart[k]} for k in range(len(places) - 1)
    ]
    best = minimize(lambda x: np.sum((x - places) ** 2), places, constraints=held, options={"ftol": 1e-14})
    assert best.success
    np.testing.assert_allclose(spread(places, heights), best.x, atol=1e-5)


@pytest.mark.parametrize("scale", ["linear", "log"])
def test_names_stand_beyond_the_panel_none_over_another_and_in_whole(scale):
    figure, (ax,) = panels()
    for k, colour in enumerate(COLOURS):
        ax.plot([1.0, 2.0, 3.0], [1.0, 2.0, 3.0 + 1e-3 * k], color=colour, label=f"line {k}")
    ax.set_yscale(scale)
    label_ends(ax)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    boxes = [text.get_window_extent(canvas.get_renderer()) for text in ax.texts]
    assert [text.get_text() for text in ax.texts] == [f"line {k}" for k in range(len(COLOURS))]
    for below, above in pairwise(boxes):
        assert above.y0 >= below.y0 + 0.8 * below.height
    assert min(box.x0 for box in boxes) >= ax.bbox.x1
    assert max(box.x1 for box in boxes) <= figure.bbox.x1 + 1.0


def test_a_name_stands_at_its_point():
    figure, (ax,) = panels()
    (line,) = ax.plot([0.0, 1.0, 4.0], [3.0, 2.0, 1.0], label="falls")
    label_line(ax, line, 0.5)
    assert (ax.texts[0].get_text(), ax.texts[0].xy) == ("falls", (1.0, 2.0))


@pytest.mark.parametrize("colour", [*COLOURS, "#ffff00", "#ffffff", "#000000"])
def test_the_colour_of_a_text_keeps_its_hue_and_is_dark_enough(colour):
    before, after = np.array(to_rgb(colour)), np.array(legible(colour))
    assert after @ [0.2126, 0.7152, 0.0722] <= 0.35 + 1e-12
    np.testing.assert_allclose(np.cross(before, after), 0.0, atol=1e-12)
