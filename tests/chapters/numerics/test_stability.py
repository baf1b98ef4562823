"""The stability study tells apart what is accurate, stable, refused, and what should have been."""

from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from drawn_whole import assert_whole
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.colors import to_hex

from chapters.numerics.answers import STEP_FOUND
from chapters.numerics.figures.stability import ENDS, LESS, SHORTEST, ended
from chapters.numerics.measured.stability import Rung, climbed, run_case, stability, standard_of
from chapters.numerics.measured.stable_step import BRACKET, HALVINGS, stable_step
from chapters.numerics.models import StabilityStudy, case_file, in_tier
from chapters.numerics.outcome import Outcome
from chapters.numerics.report.section import section
from riserstudy.chapters.draw import draw
from riserstudy.study.measured import Setting
from riserstudy.study.read import read_studies

CONFIG = Path(__file__).parents[3] / "config"
STUDY: StabilityStudy = read_studies(CONFIG, "numerics").measured["stability"]
FEW = ("surge", "step x10", "column above Euler's load", "Newmark beta 1/6")


@pytest.fixture(scope="module")
def few():
    """The study of a few cases, as in preview."""
    cases = {name: STUDY.cases[name] for name in FEW}
    return stability(STUDY.replaced(cases=cases), Setting(CONFIG, "preview", 1))


def test_a_scene_at_default_accuracy_is_accurate_and_its_estimate_bounds_the_error(few):
    surge = few.sel(case="surge")
    assert str(surge["written_outcome"].values) == Outcome.ACCURATE
    assert float(surge["written_error"]) <= float(surge["written_estimate"]) <= 0.01


def test_a_step_too_long_is_inaccurate_and_told_so(few):
    step = few.sel(case="step x10")
    assert str(step["written_outcome"].values) == Outcome.INACCURATE
    assert float(step["written_estimate"]) > 0.01


def test_a_method_that_fails_is_a_row_with_its_message(few):
    newmark = few.sel(case="Newmark beta 1/6")
    assert str(newmark["written_outcome"].values) == Outcome.REFUSED
    assert "Newton's iteration did not converge" in str(newmark["written_message"].values)
    explicit = newmark.sel({"method": "explicit"})
    assert "above the stable step" in str(explicit["message"].values)


def test_longer_steps_have_larger_errors_and_take_fewer_iterations(few):
    ladder = few.sel({"case": "surge", "method": "gen.-alpha 0.8"})
    error = ladder["error"].dropna("rung")
    assert (np.diff(error) > 0.0).all()
    assert (np.diff(ladder["newton_iterations"].dropna("rung")) < 0.0).all()


def test_a_run_of_more_node_steps_than_the_budget_is_a_row_too():
    tight = STUDY.replaced(explicit_budget=10.0)
    case = STUDY.cases["surge"]
    file = case_file(CONFIG, "surge", case)
    told = run_case(tight, case, file, "preview", standard_of(CONFIG, "surge", file.resolved()))
    assert {rung.outcome for rung in told.rungs["explicit"]} == {Outcome.TOO_LONG}


@pytest.mark.long
@given(
    st.integers(1, 12), st.integers(0, 12), st.integers(0, 12), st.integers(0, 3)
)  # fmt: skip
def test_bisection_finds_the_rungs_that_climbing_all_finds(count, accurate, survive, late):
    """Runs of the first few steps take too long, later ones are accurate, then survive, then fail."""
    tried = []

    def one(step):
        tried.append(step)
        if step <= late:
            return Rung(step, Outcome.TOO_LONG, np.nan, None)
        if step <= late + accurate:
            return Rung(step, Outcome.ACCURATE, 0.0, None)
        ends = Outcome.INACCURATE if step <= late + accurate + survive else Outcome.REFUSED
        return Rung(step, ends, np.nan, None)

    steps = list(range(1, count + 1))
    found, every = climbed(one, steps), [one(step) for step in steps]
    for good in (lambda r: r.outcome == Outcome.ACCURATE, lambda r: r.survived):
        largest = [max((r.step for r in of if good(r)), default=0) for of in (found, every)]
        assert largest[0] == largest[1]
    assert [r.step for r in found] == sorted({r.step for r in found})
    assert len(tried) - count <= 2 * np.ceil(np.log2(count + 1))


def test_every_case_of_every_tier_is_a_scene():
    for tier in ("preview", "standard"):
        for name, case in in_tier(STUDY.cases, tier).items():
            case_file(CONFIG, name, case).resolved()


def test_the_figure_has_a_square_for_every_case_and_its_title_counts_them(few):
    figure = draw("numerics", "stability", {"stability": few})
    squares = figure.axes[0].patches
    assert len(squares) == len(FEW)
    colours = Counter(map(to_hex, (square.get_facecolor() for square in squares)))
    assert colours == Counter(ENDS[end] for end in ended(few))
    assert few["as_expected"].all()
    assert figure.get_suptitle().startswith(f"All {len(FEW)} hard cases end as expected; ")


def test_the_title_counts_the_cases_that_are_silently_wrong(few):
    compared = int(few["written_outcome"].isin([str(Outcome.ACCURATE), str(Outcome.INACCURATE)]).sum())
    assert 0 < compared < len(FEW)  # a refused case has no result
    title = draw("numerics", "stability", {"stability": few}).get_suptitle()
    assert title.endswith(f"; {compared} references show no silent error")
    bad = few.copy(deep=True)
    bad["as_expected"][:2] = False
    bad["written_outcome"] = bad["written_outcome"].astype(object)
    bad["written_outcome"][0] = str(Outcome.INACCURATE)
    bad["written_outcome"][1] = str(Outcome.UNJUDGED)  # not as expected, but nothing shows that it is wrong
    title = draw("numerics", "stability", {"stability": bad}).get_suptitle()
    assert title.endswith(" references show 1 silent error")
    assert title.startswith(f"{len(FEW) - 2} of ")


def test_the_range_of_a_family_runs_from_the_accurate_to_the_surviving_step(few):
    figure = draw("numerics", "stability", {"stability": few})
    surge = few.sel({"case": "surge", "method": "gen.-alpha 0.8"})
    names = ("largest_accurate_step", "largest_stable_step")
    accurate, stable = (float(surge[name] / surge["written_step"]) for name in names)
    spans = [line.get_xdata() for line in figure.axes[1].lines if len(line.get_xdata()) == 2]
    assert accurate > SHORTEST
    assert any(np.allclose(span, [accurate, stable]) for span in spans)


def steps_that_survive(few, stable):
    """Marks of the steps that survive in the lower panel, as (marker, x), a longest one of them set."""
    changed = few.copy(deep=True)
    changed["largest_stable_step"].loc[{"case": "surge", "method": "gen.-alpha 0.8"}] = stable
    lines = draw("numerics", "stability", {"stability": changed}).axes[1].lines
    over = stable / float(few["written_step"].sel(case="surge"))
    hollow = [line for line in lines if line.get_markerfacecolor() == "none"]
    there = [line for line in hollow if len(line.get_xdata())]
    return [line.get_marker() for line in there if np.allclose(line.get_xdata(), over)]


def test_a_ladder_that_ends_before_the_method_fails_is_no_limit(few):
    longest = float(few["step"].sel({"case": "surge", "method": "gen.-alpha 0.8"}).max())
    assert steps_that_survive(few, longest)[0] == ">"
    assert steps_that_survive(few, 0.7 * longest) == ["o"]


def test_steps_shorter_than_the_axis_are_arrows_at_its_end(few):
    short = few.copy(deep=True)
    for name in ("largest_accurate_step", "largest_stable_step"):
        short[name].loc[{"method": "explicit"}] = 0.1 * SHORTEST * short["written_step"]
    axes = draw("numerics", "stability", {"stability": short}).axes
    there = [line for line in axes[1].lines if len(line.get_xdata())]
    assert min(float(np.min(line.get_xdata())) for line in there) == SHORTEST
    assert any(line.get_marker() == LESS for line in there)


def test_methods_that_did_not_run_and_ties_are_told(few):
    less = few.sel({"method": [m for m in few["method"].values if m != "ESDIRK4"]})
    figure = draw("numerics", "stability", {"stability": less})
    assert_whole(figure)
    key = figure.legends[0]
    said = [text.get_text() for text in key.get_texts()]
    assert "not run at this tier: TR-BDF2, ESDIRK4" in said
    same = few.copy(deep=True)
    same["largest_accurate_step"][:] = same["written_step"]
    title = draw("numerics", "stability", {"stability": same}).axes[1].get_title(loc="left")
    assert "tied)" in title


def test_the_two_worst_cases_are_named_with_their_errors(few):
    figure = draw("numerics", "stability", {"stability": few})
    notes = figure.axes[0].texts[-1].get_text().splitlines()
    error = few["written_error"].fillna(-1.0)
    furthest = few["case"].values[np.argsort(error.values)[::-1][:2]]
    assert {line[3:].partition(":")[0] for line in notes} == set(furthest)
    assert ", estimated " in notes[0]


def test_the_numbers_of_named_cases_increase_from_top_to_bottom(few):
    texts = draw("numerics", "stability", {"stability": few}).axes[0].texts
    places = {text.get_text(): text.get_position()[1] for text in texts if text.get_text().isdigit()}
    assert [*sorted(places, key=lambda number: (places[number], number))] == ["1", "2"]


def test_a_family_without_explicit_steps_says_why(few):
    names = ("largest_accurate_step", "largest_stable_step")
    for outcome, reason in (
        (Outcome.REFUSED, "not possible with this effect"),
        (Outcome.TOO_LONG, "runs exceed the limit of work"),
    ):
        without = few.copy(deep=True)
        without["outcome"] = without["outcome"].astype(object)
        without["outcome"].loc[{"method": "explicit"}] = str(outcome)
        for name in names:
            without[name].loc[{"method": "explicit"}] = np.nan
        said = [
            text.get_text() for text in draw("numerics", "stability", {"stability": without}).axes[1].texts
        ]
        assert f"explicit: {reason}" in said
    said = [text.get_text() for text in draw("numerics", "stability", {"stability": few}).axes[1].texts]
    assert not any(text.startswith("explicit:") for text in said)


def test_the_explicit_limit_is_a_tick_where_a_stable_step_was_predicted(few):
    figure = draw("numerics", "stability", {"stability": few})
    ticks = [line for line in figure.axes[1].lines if line.get_marker() == "|"]
    drawn = [line.get_xdata()[0] for line in ticks if len(line.get_xdata())]
    surge = few.sel(case="surge")
    assert drawn == pytest.approx([float(surge["explicit_limit"] / surge["written_step"])])
    stable = surge["largest_stable_step"].sel({"method": "explicit"})
    assert 0.5 < stable / surge["explicit_limit"] <= 1.0


def test_the_report_tells_what_is_not_as_it_should_be(few):
    chapter = section({"stability": few})
    assert chapter.sentences[0].startswith(
        f"{int(few['as_expected'].sum())} of {len(FEW)} hard cases ended with the expected outcome"
    )
    shown = [table for table in chapter.tables if not table.folded]
    named = [row[0].text for table in shown for row in table.rows]
    assert named == list(few["case"].values[~few["as_expected"]])
    table = next(table for table in chapter.tables if table.title == "Hard cases")
    assert [row[0].text for row in table.rows] == list(FEW)
    assert all(len(row) == len(table.columns) for row in table.rows)


def test_the_stated_error_of_a_stable_step_is_the_last_bracket():
    last = 100.0 * (BRACKET[1] - BRACKET[0]) / 2**HALVINGS
    assert abs(last - STEP_FOUND) < 0.05  # rounded to one digit


def test_the_stable_step_of_a_linear_riser_is_predicted_to_a_hundredth():
    model = read_studies(CONFIG, "numerics").measured["stable_step"]
    coarse = model.variants["surge"].replaced(elements=[10])
    short = model.replaced(variants={"surge": coarse}, duration="10 s")
    found = stable_step(short, Setting(CONFIG, "preview"))
    ratio = found["measured"] / found["predicted"]
    assert ratio.values.ravel() == pytest.approx([1.0], abs=0.01)
