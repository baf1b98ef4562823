"""One colour for one meaning in all figures of a chapter."""

from itertools import combinations

import numpy as np
import pytest
from matplotlib.colors import to_hex, to_rgb
from matplotlib.lines import Line2D
from test_figures import FIGURES, drawn

from riserstudy.chapters.chang2020.figures import shared as chang2020
from riserstudy.chapters.liu2020.figures import colours as liu2020
from riserstudy.figures.style import shades

#: tables of a chapter, and groups of meanings that are one thing
TABLES = {
    "chang2020": (chang2020.OF_MODEL, chang2020.OF_STATE, chang2020.OF_START, chang2020.OF_MASS),
    "liu2020": (
        liu2020.OF_TOP,
        liu2020.OF_MOTION,
        {"waves on the riser": liu2020.WITH_WAVES},
        liu2020.OF_PROFILE,
        liu2020.OF_CALIBRATION,
    ),
}
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
}
MOST_SHADES = 6
APART = 0.2  # least distance of two colours, of 1.7 from black to white
CHAPTER_FIGURES = [(paper, name) for paper, name in FIGURES if paper in TABLES]


def meanings(paper):
    """All meanings of a chapter with their colours."""
    return [item for table in TABLES[paper] for item in table.items()]


def base_of(paper, colour):
    """The assigned colour that one is, or is a shade of; "neutral" for grey; None for any other."""
    red, green, blue = to_rgb(colour)
    if max(red, green, blue) - min(red, green, blue) < 0.02:
        return "neutral"
    for _, base in meanings(paper):
        known = {base, *(s for count in range(2, MOST_SHADES + 1) for s in shades(base, count))}
        if to_hex(colour) in known:
            return base
    return None


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


@pytest.mark.parametrize("paper", TABLES)
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
