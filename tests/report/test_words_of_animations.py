"""Words around an animated riser: they fit beside each other, and large numbers are written out."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

from riserstudy.report.animation import BAR, HISTORIES, animation
from riserstudy.report.motion import History, Motion

LETTER = 5.6  # px, mean width of a letter of 11 px
WIDTH = 860.0  # px, of the panels where the contents are at the side
ROW = 100.0  # px, height of one of three histories and its gap, on a narrow screen
QUANTITIES = ("effective tension", "bending moment")
LABELS = ("platform (m)", "largest moment (kN m)", "top tension (kN)", "flex joints (°)", "stroke (m)")


def figure_of(seed, space):
    """The figure of a riser of random motion, in the plane or in space, with three histories."""
    draw = np.random.default_rng(seed)
    time, nodes = np.linspace(0.0, 10.0, 4), 5
    x, y = draw.normal(size=(2, 4, nodes))
    z = np.tile(np.linspace(0.0, draw.uniform(100.0, 2000.0), nodes), (4, 1))
    histories = [
        History(str(label), {"top": draw.normal(size=9) * 1e5})
        for label in draw.choice(LABELS, 3, replace=False)
    ]
    motion = Motion(
        title="a riser", scene=SimpleNamespace(water=None, lateral=True), time=time, x=x,
        y=y if space else None, z=z, rest=(x[0], z[0]), colour=1e5 * draw.normal(size=(4, nodes)),
        quantity=str(draw.choice(QUANTITIES)), unit="kN", signed=bool(draw.integers(2)), platform=None,
        moments=np.linspace(0.0, 10.0, 9), histories=histories,
    )  # fmt: skip
    return json.loads(animation(motion)), motion


@pytest.mark.parametrize("space", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_words_fit_between_the_riser_and_its_histories(seed, space):
    """The colour bar's title met the labels of the histories, and a long label those of its neighbours."""
    figure, motion = figure_of(seed, space)
    bar = next(
        one["colorbar"] for trace in figure["data"] for one in (trace.get("marker"), trace.get("line"))
        if isinstance(one, dict) and "colorbar" in one
    )  # fmt: skip
    rows = bar["title"]["text"].split("<br>")
    assert " ".join(rows) == f"{motion.quantity} (kN)"
    labels = 3 * 14.0 + 50.0  # px: three rows of a label, upright, and numbers
    assert LETTER * max(map(len, rows)) < (HISTORIES - BAR) * WIDTH - labels
    shown = [axis["title"]["text"] for name, axis in figure["layout"].items() if name.startswith("yaxis")]
    for history in motion.histories:
        (label,) = [text for text in shown if text.replace("<br>(", " (").startswith(history.label)]
        assert LETTER * max(len(row) for row in label.split("<br><span")[0].split("<br>")) < ROW


@pytest.mark.parametrize("space", [False, True])
def test_numbers_are_written_out_with_a_space_between_thousands(space):
    """Plotly writes 10 000 kN as 10k unless it is told otherwise."""
    figure, _ = figure_of(0, space)
    assert figure["layout"]["separators"] == ".\u00a0"
    axes = [axis for name, axis in figure["layout"].items() if name[1:5] == "axis"]
    assert axes
    assert all(axis["exponentformat"] == "none" for axis in axes)
