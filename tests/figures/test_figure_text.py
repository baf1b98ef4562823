"""What is said of a figure to those who do not see it."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from riserstudy.figures import save
from riserstudy.figures.figure_text import csv_table, description


def test_panels_have_the_names_of_the_axes_that_they_share():
    figure = Figure()
    above, below = figure.subplots(2, 1, sharex=True)
    figure.suptitle("Heave grows")
    figure.supylabel("heave (m)")
    for ax, letter, title in ((above, "(a)", "1 m"), (below, "(b)", "3 m")):
        ax.plot([0.0, 1.0], [0.0, 2.0], label="gas law")
        ax.set_title(letter, loc="left")
        ax.set_title(title, loc="right")
    below.set_xlabel("time (s)")
    said = description(figure)
    assert said.startswith("Heave grows. 2 panels. ")
    assert "(a) 1 m: heave (m) over time (s): gas law." in said
    assert "(b) 3 m: heave (m) over time (s): gas law." in said
    first = csv_table(figure).splitlines()[1]
    assert first.startswith("(a),time (s),heave (m),gas law,0,0")


def test_a_name_on_two_rows_is_one_name():
    figure = Figure()
    ax = figure.subplots()
    ax.plot([0.0, 1.0], [0.0, 2.0], label="secant,\nright axis")
    assert csv_table(figure).splitlines()[1].split(",", 3)[3].startswith('"secant, right axis",0,0')


def rows_of(figure):
    """Names and values of the series of a figure without commas in its words."""
    rows = (line.split(",") for line in csv_table(figure).splitlines()[1:])
    return [(row[3], float(row[4]), float(row[5])) for row in rows]


@pytest.mark.parametrize("ends", [(3.0, 1.0), (-2.0, 4.0)])
def test_a_bar_is_told_by_the_end_that_its_value_sets(ends):
    figure = Figure()
    beside, upright = figure.subplots(1, 2)
    beside.barh([0.0, 1.0], ends)
    upright.bar([0.0, 1.0], ends)
    lying = [("", end, row) for row, end in enumerate(ends)]
    standing = [("", row, end) for row, end in enumerate(ends)]
    assert rows_of(figure) == lying + standing


def test_lines_of_one_value_and_steps_of_a_histogram_are_told():
    figure = Figure()
    left, right = figure.subplots(1, 2)
    x, y = np.linspace(0.0, 1.0, 5), np.linspace(0.0, 2.0, 9)
    left.contour(x, y, x + y[:, None], levels=[1.0]).set_label("sum of 1")
    right.hist([0.5, 0.5, 1.5], [0.0, 1.0, 2.0], histtype="step", label="samples")
    told = rows_of(figure)
    line = [(a, b) for name, a, b in told if name == "sum of 1"]
    assert len(line) > 4
    np.testing.assert_allclose(np.sum(line, axis=1), 1.0)
    steps = [(a, b) for name, a, b in told if name == "samples"]
    assert {(0.0, 2.0), (1.0, 2.0), (1.0, 1.0), (2.0, 1.0)} <= set(steps)


@pytest.mark.parametrize("engine", ["constrained", "tight", "none"])
def test_a_figure_has_one_layout_in_all_formats_and_is_prepared_once(tmp_path, monkeypatch, engine):
    figure = Figure(layout=engine)
    left, right = figure.subplots(1, 2)
    left.plot([0.0, 1.0], [0.0, 2e6])
    right.set_ylabel("a long name of the ordinate")
    draw, drawn = Figure.draw, []

    def counted(self, renderer):
        drawn.append([ax.get_position().bounds for ax in self.axes])
        draw(self, renderer)

    monkeypatch.setattr(Figure, "draw", counted)
    targets = [tmp_path / f"a.{kind}" for kind in ("png", "pdf", "svg", "csv")]
    save(figure, *targets)
    assert all(target.stat().st_size for target in targets)
    assert len(drawn) == 1 + 3  # for the layout, and for each picture
    assert drawn[1] == drawn[2] == drawn[3]
