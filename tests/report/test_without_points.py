"""What the report says of verdicts without the points whose error is too large."""

import json
import sqlite3

import pytest

from riserstudy.report.without_points import places, without_points

CLAIM, STUDY = ("paper", "C1"), "paper/runs"
LABELS = ["a; b", "a, speed=1.0", 'o\'clock "x"']
TABLES = """
create table numbers_and_claims (paper, id, kind, verdict);
create table margins (paper, id, place, base, judged, met, same, margin, calibrated, rests_on);
create table studies (study, axes, table_name);
create table columns (table_name, column_name, role, position);
create table "odd ""name" (point integer primary key, "line" text, "speed_2" real);
"""


@pytest.fixture
def db():
    """A claim that is true at two lines of three, whose points also vary in a speed that is reduced."""
    db = sqlite3.connect(":memory:")
    db.executescript(TABLES)
    table = 'odd "name'
    db.execute("insert into studies values (?, ?, ?)", (STUDY, '{"line": 3, "speed": 2}', table))
    for position, (name, role) in enumerate([("point", "row"), ("line", "axis"), ("speed_2", "axis")]):
        db.execute("insert into columns values (?, ?, ?, ?)", (table, name, role, position))
    points = [(10 + k, LABELS[k // 2], float(k % 2)) for k in range(6)]
    db.executemany('insert into "odd ""name" values (?, ?, ?)', points)
    db.execute("insert into numbers_and_claims values (?, ?, 'claim', 'depends')", CLAIM)
    for label, met in zip(LABELS, (1, 0, 1), strict=True):
        case = (json.dumps({"line": label}), label == LABELS[0], 1, met, 0, 0.1 if met else -0.1, 0)
        row = (*CLAIM, *case, json.dumps({STUDY: ["line"]}))
        db.execute("insert into margins values (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", row)
    return db


def test_a_verdict_that_a_point_alone_made_turns_without_it(db):
    for point in (12, 13):  # at either speed
        found = without_points(db, [CLAIM], {STUDY: [point]})
        assert found.turned == [(CLAIM, "holds")]
        said = "If points with larger errors are left out, 1 of the verdicts changes"
        assert found.turning.endswith(said)
        assert found.left == ""


def test_other_points_leave_a_verdict_as_it_is(db):
    for off in ({STUDY: [14]}, {STUDY: []}, {}):
        found = without_points(db, [CLAIM], off)
        assert (found.stand, found.turned, found.bound) == ([CLAIM], [], [])
        assert found.turning.endswith(
            "If points with larger errors are left out, none of the verdicts changes"
        )


def test_what_rests_on_such_points_in_its_base_or_in_every_case_cannot_be_graded(db):
    for points in ([10, 12], [*range(10, 16)]):
        found = without_points(db, [CLAIM], {STUDY: points})
        assert found.bound == [CLAIM]
        assert found.left.startswith("One verdict cannot be graded")


def test_a_fitted_value_stays_one(db):
    db.execute("update margins set calibrated = 1")
    assert without_points(db, [CLAIM], {STUDY: [12]}).turned == [(CLAIM, "calibrated")]


def test_places_of_points_are_those_of_their_axes_whatever_the_labels(db):
    found = places(db, STUDY, [11, 12, 15])
    assert found == [
        {"line": LABELS[0], "speed": 1.0},
        {"line": LABELS[1], "speed": 0.0},
        {"line": LABELS[2], "speed": 1.0},
    ]
