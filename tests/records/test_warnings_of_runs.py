"""Warnings are records: users see their sentences, and reports join those of one kind."""

import ast
import json
import re
import sqlite3
from pathlib import Path
from string import Formatter

import pytest
from warned_rigs import warned_rig, warned_run

import riserstudy
from riserstudy.dataset.label import to_dataset
from riserstudy.records.facts import point_columns
from riserstudy.records.warning import joint_sentence, sentence, sentences, warning
from riserstudy.report.audit import warned

CASES = [(seed, spatial) for seed in range(24) for spatial in (False, True)]
UNITS = {"N": 1.0, "kN": 1e3, "%": 0.01, "run": 1.0, "runs": 1.0}
# largest relative rounding of a value in a sentence: two digits, or two digits rounded down
ROUNDED, ROUNDED_DOWN = 0.05, 0.1


def places(text, filled):
    """What stands in each place of a text, by name and format; the text around is as in the record."""
    pattern, names = "", []
    for before, name, spec, _ in Formatter().parse(text):
        pattern += re.escape(before) + ("(.+?)" if name is not None else "")
        names += [(name, spec)] if name is not None else []
    found = re.fullmatch(pattern, filled, re.DOTALL)
    assert found, (text, filled)
    return zip(names, found.groups(), strict=True)


def ends(written):
    """Smallest and largest number of a place, with the unit that a format adds."""
    numbers = [one.removeprefix("< ").split() for one in re.split(r" to | … ", written)]
    values = [float(one[0]) * UNITS[one[1]] if len(one) > 1 else float(one[0]) for one in numbers]
    return values[0], values[-1]


def runs():
    """Runs of the cases that have an equilibrium, with their cases."""
    found = ((case, warned_run(*case)) for case in CASES)
    return [(case, result) for case, result in found if result is not None]


@pytest.fixture(scope="module")
def made():
    return runs()


@pytest.mark.long
def test_users_see_the_sentences_of_the_records(made):
    """In attributes and datasets, each record has its sentence; a place holds its value, as written."""
    columns = {column.name: column for column in point_columns()}
    assert len({one["kind"] for _, result in made for one in result.facts["warnings"]}) > 20
    for case, result in made:
        told = result.facts["warnings"]
        attributes = to_dataset(result, warned_rig(*case), {}).attrs
        stored = json.loads(columns["warning_records"].value(result.facts))
        assert stored == told
        assert json.loads(attributes["warnings"]) == sentences(stored)
        assert columns["warnings"].value(result.facts).splitlines() == sentences(stored)
        for one in told:
            assert {name for (name, _), _ in places(one["text"], sentence(one))} == {*one["values"]}
            for (name, spec), written in places(one["text"], sentence(one)):
                value = one["values"][name]
                if isinstance(value, str):
                    assert written == value
                elif not isinstance(value, dict):
                    assert ends(written)[0] == pytest.approx(value, rel=ROUNDED), (name, spec)


def table(records):
    """A database with these warnings as points, of two studies in turn."""
    db = sqlite3.connect(":memory:")
    db.execute("create table points (point, study, warnings, warning_records)")
    for number, (lines, cell) in enumerate(records):
        db.execute("insert into points values (?, ?, ?, ?)", (number, f"study {number % 2}", lines, cell))
    return db


def test_the_warnings_of_a_study_are_joined_by_their_kind_with_all_values_within_the_ranges(made):
    facts = [result.facts["warnings"] for _, result in made]
    rows = warned(table([("\n".join(sentences(one)), json.dumps(one)) for one in facts]))
    every = [one for of_run in facts for one in of_run]
    kinds = {}
    for one in every:
        kinds.setdefault(one["kind"], []).append(one)
    assert sum(row.number for row in rows) == len(every)
    assert sorted(row.number for row in rows) == sorted(map(len, kinds.values()))
    joint = {joint_sentence(of_kind): of_kind for of_kind in kinds.values()}
    assert {row.text: row.number for row in rows} == {text: len(of_kind) for text, of_kind in joint.items()}
    for text, of_kind in joint.items():
        assert len({one["text"] for one in of_kind}) == 1
        for (name, spec), written in places(of_kind[0]["text"], text):
            values = [one["values"][name] for one in of_kind]
            if isinstance(values[0], str):
                assert written.removesuffix(" or others") in " or ".join(dict.fromkeys(values))
            elif not isinstance(values[0], dict):
                allowed = ROUNDED_DOWN if spec == "at_most" else ROUNDED
                assert ends(written) == pytest.approx((min(values), max(values)), rel=allowed), name


@pytest.mark.long
def test_a_kind_has_one_place_in_the_sources():
    """Otherwise, two different warnings could be joined."""
    kinds = [
        call.args[0].value
        for path in Path(riserstudy.__file__).parent.rglob("*.py")
        for call in ast.walk(ast.parse(path.read_text()))
        if isinstance(call, ast.Call)
        and getattr(call.func, "id", "") in ("warning", "_doubt", "_slip")
        and isinstance(call.args[0], ast.Constant)
    ]
    assert len(kinds) == len(set(kinds)) > 40


def test_a_range_can_have_two_units_and_names_are_listed():
    text = "{stop}: first reaches its stop at t = {first:.6g} s, with {force:newtons}"
    given = [("stroke", 11.0, 850.0), ("joint", 9.0, 1234.0), ("stroke", 9.5, 20.0)]
    told = [warning("stop", text, {"stop": s, "first": t, "force": f}) for s, t, f in given]
    assert joint_sentence(told) == (
        "stroke or joint: first reaches its stop at t = 9 to 11 s, with 20 N to 1.23 kN"
    )
    assert joint_sentence(told[:1]) == sentence(told[0])
    told = [warning("kind", "{name} is odd", {"name": name}) for name in "abcdeabc"]
    assert joint_sentence(told) == "a or b or c or others is odd"


def test_errors_are_joined_by_quantity():
    text = "{runs:run}: {errors:percent}"
    errors = [{"moment": 0.02, "lift": 0.1}, {"moment": 0.005}, {"moment": 0.01, "top_angle": 0.3}]
    told = [warning("error", text, {"errors": one, "runs": k + 1}) for k, one in enumerate(errors)]
    assert sentence(told[0]) == "1 run: moment 2 %, lift 10 %"
    assert joint_sentence(told) == "1 run to 3 runs: moment 0.5 % to 2 %, lift 10 %, top angle 30 %"


def test_an_error_that_grows_later_leaves_a_warning_as_it_was():
    errors = {"damage": 0.02}
    told = warning("error", "{errors:percent}", {"errors": errors})
    errors["damage"] = 0.5
    assert sentence(told) == "damage 2 %"


def test_a_text_that_has_the_word_of_a_range_gets_another():
    told = [warning("fall", "falls to {least:.3g} N", {"least": least}) for least in (-120.0, -3.5e6)]
    assert joint_sentence(told) == "falls to -3.5e+06 … -120 N"


def test_points_of_earlier_versions_have_a_row_for_each_sentence():
    """Their datasets contain sentences only."""
    odd = warning("odd", "odd by {much:g}", {"much": 3.0})
    lines = ["a {strange} sentence", "another"]
    old = [("\n".join(lines), ""), (lines[1], "")]
    rows = warned(table([*old, (sentence(odd), json.dumps([odd]))]))
    assert [(row.text, row.number) for row in rows] == [(lines[1], 2), (lines[0], 1), ("odd by 3", 1)]
    assert rows[0].datasets == ["study 0", "study 1"]
