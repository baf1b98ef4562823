"""One colour for one meaning in all figures of a chapter."""

from itertools import combinations

import numpy as np
import pytest
from colours_of_chapters import MOST_SHADES, TABLES, base_of, meanings
from matplotlib.colors import to_hex, to_rgb
from matplotlib.lines import Line2D
from test_figures import FIGURES, drawn

from riserstudy.figures.style import shades

pytestmark = pytest.mark.long

#: groups of meanings that are one thing
SAME = {
    "chang2020": [
        {"linear", "least squares over -8 to 8 m"},
        {"from_rest", "unstretched"},
        {"gas law", "at the ring"},
    ],
    "liu2020": [
        {"exponential 50 m", "8765 N by all cylinders"},
        {"exponential 200 m", "8765 N by one cylinder"},
    ],
    "mao_hangoff": [],
}
APART = 0.2  # least distance of two colours, of 1.7 from black to white
#: of papers that are drawn here; those of mao_hangoff are with their datasets
CHAPTER_FIGURES = [(paper, name) for paper, name in FIGURES if paper in TABLES]


@pytest.mark.parametrize("paper", TABLES)
def test_a_colour_has_one_meaning(paper):
    for (one, first), (other, second) in combinations(meanings(paper), 2):
        away = np.linalg.norm(np.subtract(to_rgb(first), to_rgb(second)))
        assert (away == 0.0) == any({one, other} <= group for group in SAME[paper]), (one, other)
        assert away == 0.0 or away >= APART, (one, other)


@pytest.mark.parametrize("paper, name", CHAPTER_FIGURES)
def test_a_figure_has_the_colours_of_its_chapter_only(paper, name):
    figure = drawn(paper, name)
    lines = [line.get_color() for line in figure.findobj(Line2D)]
    bars = [patch.get_facecolor() for ax in figure.axes for patch in ax.patches]
    for colour in [*lines, *bars]:
        assert base_of(paper, colour), to_hex(colour)


@pytest.mark.parametrize("paper", dict(CHAPTER_FIGURES))
def test_a_name_has_one_colour_in_a_chapter(paper):
    found = {}
    for of, name in CHAPTER_FIGURES:
        if of == paper:
            for line in [line for ax in drawn(of, name).axes for line in ax.lines]:
                label = str(line.get_label())
                if label and not label.startswith("_"):
                    found.setdefault(label, set()).add(base_of(paper, line.get_color()))
    assert found
    assert {label: bases for label, bases in found.items() if len(bases) > 1} == {}


@pytest.mark.parametrize("count", range(2, MOST_SHADES + 1))
@pytest.mark.parametrize("colour", ["#0072b2", "#009e73", "#882255"])
def test_shades_go_from_light_to_dark(colour, count):
    light = [float(np.dot((0.2126, 0.7152, 0.0722), to_rgb(one))) for one in shades(colour, count)]
    assert (np.diff(light) < 0.0).all()
    assert light[0] < 0.75  # is seen on white
