"""CSV files: no text is a formula in a spreadsheet, numbers stay numbers, texts are read as written."""

import csv
import io
import json
from dataclasses import dataclass

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from matplotlib.figure import Figure

from riserstudy.errors import SimulationError
from riserstudy.figures.figure_text import csv_table as values_of_figure
from riserstudy.files.csv_files import csv_text, read_csv, write_csv
from riserstudy.grading.rows import table as graded

FORMULAS = [
    "=1+1", '=cmd|" /C calc"!A0', "+1+cmd|x", "-2+3", "@SUM(1)", "\t=1", "\r=1", "\n=1", " =1+1",
    "'=1", "''=1", "\u00a0=1", "\ufeff=1", "\u200b=1", "＝1+1", "－1+A1", "＠A1", '=HYPERLINK("http://x")',
    "=1;=2", "a\r=1+1", "a\r\n=1+1", 'a",=1', "-", "+", "=", "-5 m", "--1", "1e5\r-A1",
]  # fmt: skip
pieces = st.sampled_from(["=", "+", "-", "@", "\t", "\r", "\n", "'", '"', ",", " ", "a", "1", "\ufeff"])
texts = st.one_of(
    st.sampled_from(FORMULAS),
    st.lists(pieces, max_size=6).map("".join),
    st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=12),
)
numbers = st.one_of(st.integers(), st.floats(), st.none())


def cells_of(text):
    """Rows as a spreadsheet finds them, which ends a line at any kind of end."""
    return list(csv.reader(io.StringIO(text, newline=None), strict=True))


def is_harmless(cell):
    """Whether a cell is no formula: by its first character, or because all of it is a number."""
    first = cell.strip(" \u00a0\ufeff\u200b")[:1]
    if first not in tuple("=+-@\t＝＋－＠") or not first:
        return True
    try:
        float(cell)
    except ValueError:
        return False
    return True


@given(st.lists(st.tuples(texts, numbers, texts), max_size=4), st.lists(texts, min_size=3, max_size=3))
@example([(text, -1.5, text) for text in FORMULAS], ["=a", "-b", "@c"])
def test_no_text_is_a_formula_and_no_number_a_text(rows, header):
    found = cells_of(csv_text(header, rows))
    assert len(found) == 1 + len(rows)
    assert all(len(line) == 3 for line in found)
    assert all(is_harmless(cell) for line in found for cell in line)
    for (_, number, _), line in zip(rows, found[1:], strict=True):
        assert line[1] == ("" if number is None else str(number))


@given(st.lists(st.tuples(texts, texts), max_size=5))
@example([(text, f"'{text}") for text in FORMULAS])
def test_texts_are_read_as_they_were_but_for_the_kind_of_line_end(tmp_path_factory, rows):
    path = tmp_path_factory.mktemp("csv") / "a.csv"
    write_csv(path, ["=one", "two"], rows)
    found = [(row["=one"], row["two"]) for row in read_csv(path)]
    assert found == [tuple(_same_ends(text) for text in row) for row in rows]


def _same_ends(text):
    return text.replace("\r\n", "\n").replace("\r", "\n")


@pytest.mark.parametrize("number", ["-1", "+2", "-1.5e-3", "-.5", "-inf", "1e5", "-0"])
def test_a_number_that_is_given_as_text_stays_a_number(number):
    assert cells_of(csv_text(["x"], [[number]]))[1] == [number]


def test_a_file_that_cannot_be_written_leaves_what_was_there(tmp_path):
    (tmp_path / "a.csv").mkdir()
    with pytest.raises(SimulationError, match="cannot be written"):
        write_csv(tmp_path / "a.csv", ["x"], [[1]])
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


@dataclass
class Line:
    """As tables of graded numbers have them."""

    id: str
    note: str | None
    margin: float | None


@pytest.mark.parametrize("formula", FORMULAS)
def test_tables_of_figures_and_verdicts_hold_no_formula(formula):
    figure = Figure()
    axes = figure.add_subplot(xlabel=formula, ylabel=formula, title=formula)
    axes.plot([1.0, -2.0], [-3.0, 4.0], label=formula)
    drawn = cells_of(values_of_figure(figure))
    assert ["1", "-3"] in [line[4:6] for line in drawn]
    verdicts = cells_of(graded([Line(formula, formula, -0.5), Line("a", None, None)], Line))
    assert [line[2] for line in verdicts] == ["margin", "-0.5", ""]
    assert all(is_harmless(cell) for line in [*drawn, *verdicts] for cell in line)


SCENE = {
    "title": "=title", "gravity": "9.81 m/s^2",
    "water": {"density": "1025 kg/m^3", "surface": "300 m"},
    "riser": [
        {
            "name": name, "length": "150 m", "outer_diameter": "0.5 m", "inner_diameter": "0.46 m",
            "young_modulus": "210 GPa", "mass": "400 kg/m", "submerged_weight": "2 kN/m",
        }
        for name in ('=HYPERLINK("http://x")', "-2+3")
    ],
    "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": "free",
               "body": {"name": "@foot", "mass": "2 t", "density": "7850 kg/m^3"}},
    "top": {"x": "platform", "z": "free", "tension": "1.5 MN", "rotation": "free",
            "body": {"name": "+ring", "mass": "2 t", "density": "7850 kg/m^3"}},
    "platform": {"surge": {"amplitude": "1 m", "period": "10 s"}},
    "limits": [{"output": "bending_moment", "largest": "1 MN*m", "mode": "drilling"}],
    "analysis": {"duration": "5 s", "mesh": {"elements": 6}, "step": "0.1 s",
                 "output": {"interval": "0.5 s"}},
}  # fmt: skip


def test_no_table_of_a_command_holds_a_formula(commands, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.yaml").write_text(json.dumps(SCENE))
    runs = [["run", "scene.yaml", "-o", "run.nc"], ["run", "scene.yaml", "-o", "run.csv"]]
    kinds = ("stack-up", "extremes", "time-series", "limits")
    runs += [["table", "run.nc", "--kind", kind, "-o", f"{kind}.csv"] for kind in kinds]
    runs += [["statistics", "run.nc", "-o", "statistics.csv"]]
    for words in runs:
        code, _, error = commands(*words)
        assert code == 0, error
    for path in tmp_path.glob("*.csv"):
        lines = cells_of(path.read_text())
        assert len({len(line) for line in lines}) == 1, path
        assert all(is_harmless(cell) for line in lines for cell in line), path
    stack_up = cells_of((tmp_path / "stack-up.csv").read_text())
    assert [line[0] for line in stack_up[1:]] == ["'+ring", "'-2+3", '\'=HYPERLINK("http://x")', "'@foot"]
    dry = stack_up[0].index("dry weight (kN)")
    assert float(stack_up[2][dry]) == pytest.approx(400.0 * 150.0 * 9.81e-3)
