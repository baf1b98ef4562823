"""What becomes of verdicts without the points whose error is too large."""

import sqlite3

import pytest

from riserstudy.report.without import without

CLAIM = ("paper", "C1")
STUDY = "paper/runs"


def graded(margins, off, kind="claim", verdict="depends", at_base=None):
    """One verdict by the margins of its cases, graded anew without points at some places."""
    db = sqlite3.connect(":memory:")
    db.executescript(
        """
        create table numbers_and_claims (paper, id, kind, verdict, margin);
        create table margins (paper, id, place, margin);
        create table simulated_behind (study, source);
        """
    )
    db.execute("insert into simulated_behind values (?, ?)", (STUDY, STUDY))
    db.execute(
        "insert into numbers_and_claims values (?, ?, ?, ?, ?)", (*CLAIM, kind, verdict, at_base)
    )
    for place, margin in margins.items():
        db.execute("insert into margins values (?, ?, ?, ?)", (*CLAIM, place, margin))
    return without(db, [CLAIM], {STUDY: off}, {CLAIM: {STUDY}})


SAMPLES = {"sample=1": 0.2, "sample=2": 0.1, "sample=12": -0.1}


def test_a_verdict_that_a_point_alone_made_turns_without_it():
    found = graded(SAMPLES, ["sample=12, speed=1.0"])
    assert found.turned == [(CLAIM, "holds")]
    said = "Without these points 1 of the 1 verdicts that can be graded anew turns"
    assert (found.turning, found.left) == (said, "")


def test_other_samples_leave_a_verdict_as_it_is():
    found = graded(SAMPLES, ["sample=2, speed=1.0"])  # and not sample 12
    assert (found.stand, found.turned) == ([CLAIM], [])
    assert found.turning.startswith("Without these points none of the 1 verdicts")


def test_axes_that_only_one_of_both_has_do_not_tell_them_apart():
    cases = {"sample=1; line=a chord": 0.1, "sample=2; line=a chord": -0.1}
    assert graded(cases, ["reading=a, b, sample=2"]).turned == [(CLAIM, "holds")]
    assert graded({"line=a": 0.1, "line=b": -0.1}, ["speed=1.0"]).bound == [CLAIM]


@pytest.mark.parametrize("off", [["sample=1", "sample=2", "sample=12"], [""]])
def test_what_rests_on_such_a_point_in_every_case_cannot_be_graded(off):
    found = graded(SAMPLES, off)
    assert found.bound == [CLAIM]
    assert found.left.startswith("1 cannot")


def test_a_number_keeps_its_base_case():
    assert graded(SAMPLES, ["sample=1"], "number", "depends", 0.5).stand == [CLAIM]
    met = graded(SAMPLES, ["sample=12"], "number", "depends", 0.5)
    assert met.turned == [(CLAIM, "reproduced")]


def test_a_verdict_of_other_datasets_stands():
    found = graded(SAMPLES, [])
    assert found.stand == [CLAIM]


def test_a_case_whose_margin_is_no_number_is_not_true():
    cases = {"sample=1": 0.2, "sample=2": None, "sample=3": 0.1}
    assert graded(cases, ["sample=1"]).stand == [CLAIM]  # one of two
    assert graded(cases, ["sample=1", "sample=3"]).turned == [(CLAIM, "fails")]
