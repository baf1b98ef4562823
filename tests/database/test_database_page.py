"""The page about the database agrees with the database, and its questions can be asked."""

import re
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
import workspace
from page import COMMANDS, PYTHON, QUESTIONS, TEXT

from riserstudy import cli, query

SAID = set(re.findall(r"`([^`\n]+)`", TEXT))


def test_the_page_names_every_table_and_every_column(here):
    wide = {name for (name,) in query("select distinct table_name from columns").to_numpy()}
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        tables = db.execute("select name from sqlite_master where type in ('table', 'view')")
        names = [name for (name,) in tables if name not in wide and not name.startswith("sqlite_")]
        columns = {c[1] for name in names for c in db.execute(f"pragma table_info({name})")}
    assert {*names} - SAID == set()
    assert columns - SAID == set()


def test_there_are_ten_questions_with_an_answer_each():
    assert len(QUESTIONS) == 10
    assert all(answer.count("\n") >= 1 for _, _, answer in QUESTIONS)


@pytest.mark.parametrize("number, sql, answer", QUESTIONS, ids=lambda of: str(of)[:2])
def test_an_answer_has_the_columns_that_the_page_shows(here, number, sql, answer):
    if "chang2020_" in sql:
        pytest.skip("asks the wide table of a chapter: tried in the workflow's tests")
    assert query(sql).columns.tolist() == re.split(r"\s{2,}", answer.splitlines()[0].strip())


def test_questions_about_claims_and_assumptions_find_those_of_a_small_study(here):
    found = {number: query(sql) for number, sql, _ in QUESTIONS if "chang2020" not in sql}
    balance, assumed, errors = (found[number] for number in (6, 5, 7))
    assert balance[["id", "share", "decided_by"]].values.tolist() == [
        ["A1", 0.25, "period; in s: 9. Or 12"],
        ["A2", 0.25, "period; in s: 9. Or 12"],
    ]
    row = assumed[assumed["path"] == "platform.surge.amplitude"].iloc[0]
    assert (row["as_written"], row["because"]) == ("2 m", workspace.INJECTION)
    assert errors.set_index("study")["points"].to_dict().items() >= {"plain/surge": 6}.items()


def test_the_commands_of_the_page_are_there():
    commands = {command.callback.__name__ for command in cli.app.registered_commands}
    assert {command.split()[1] for command in COMMANDS} <= commands


def test_the_python_of_the_page_runs(here):
    exec(compile(PYTHON, str(Path("docs/results_database.md")), "exec"), {})
