"""Databases of others: whatever stands in the place of a table, commands end and write nothing."""

import random
import sqlite3
import time
from contextlib import closing

import pytest

from riserstudy.database import ask
from riserstudy.database.build import schema
from riserstudy.database.write_papers import _graded
from riserstudy.errors import InputError

SCHEMA = schema()
TABLES = ("about", "studies", "files", "points", "columns", "papers", "effect_sets")
ENDLESS = "with recursive n(i) as (select 1 union all select i + 1 from n) "
#: what a view could be, each with the columns of the table in whose place it stands
VIEWS = {
    "never ends": ENDLESS + "select {columns} from n",
    "finds nothing, and never ends": ENDLESS + "select {columns} from n where i < 0",
    "counts without end": ENDLESS + "select {columns} from (select count(*) as i from n)",
    "crosses itself": "select {columns} from (" + ENDLESS + "select a.i from n a, n b, n c)",
    "sorts without end": ENDLESS + "select {columns} from n order by random()",
    "long texts": ENDLESS + "select {columns} from (select hex(zeroblob(450000)) as i from n)",
    "larger texts than any": "select {columns} from (select hex(zeroblob(900000000)) as i)",
    "searches long texts": (
        "select {columns} from (select instr(hex(zeroblob(150000)), hex(zeroblob(75000)) || 'a') as i)"
    ),
    "likes long patterns": (
        "select {columns} from (select hex(zeroblob(450000)) like"
        " replace(hex(zeroblob(400)), '0', '%0') || 'x' as i)"
    ),
    "no such function": "select {columns} from (select nowhere(1) as i)",
    "no such table": "select {columns} from (select 1 as i from nowhere)",
    "itself": "select * from {table}",
    "another kind": "select x'00ff' as whatever",
    "nothing": "select 1 where 0",
    "reads files": "select readfile('/etc/passwd')",
    "loads code": "select load_extension('libm.so.6')",
    "pragma": "select * from pragma_table_info('points')",
}
COMMANDS = [
    ["results"],
    ["results", "a/b"],
    ["results", "two", "words"],
    ["results", "a/b", "--where", "x > 1"],
    ["sql", "select * from {table}"],
    ["sql", "select count(*) from {table}", "--csv", "out.csv"],
    ["verify"],
]
SOON = 0.1  # seconds that a statement may take here
LATEST = 30.0  # seconds that a command may take, of several statements and long single steps


def database(folder, table, view):
    """A database with a view in place of a table."""
    (folder / "results").mkdir()
    with closing(sqlite3.connect(folder / "results/results.sqlite")) as db, db:
        db.executescript(SCHEMA)
        names = [row[1] for row in db.execute(f"pragma table_info({table})")]
        db.execute("pragma foreign_keys = off")
        db.execute("insert into about values ('1', 'test')")
        db.execute(f"drop table {table}")
        columns = ", ".join(f"i as {name}" for name in names)
        db.execute(f"create view {table} as " + view.format(columns=columns, table=table))


@pytest.mark.long
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("kind", VIEWS)
def test_no_view_holds_a_command_up_or_lets_it_write(commands, tmp_path, monkeypatch, kind, seed):
    monkeypatch.setattr(ask, "LONGEST_STATEMENT", SOON)
    monkeypatch.chdir(tmp_path)
    rng = random.Random(f"{kind} {seed}")
    table = "about" if seed == 0 else rng.choice(TABLES)
    database(tmp_path, table, VIEWS[kind])
    for words in (COMMANDS[4], *rng.sample(COMMANDS, 2)):
        words = [word.format(table=table) for word in words]
        began = time.monotonic()
        code, _, error = commands(*words)
        assert time.monotonic() - began < LATEST, words
        # 0 where nothing is asked of the view, or it is harmless; 1 of verify
        assert code in (0, 1, 2), (words, error)
        notes = error.count("riserstudy: note: no ")
        assert error.count("\n") - notes == (code == 2), (words, error)
        left = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*")}
        assert left <= {"results", "results/results.sqlite"} | ({"out.csv"} if code == 0 else set())
        (tmp_path / "out.csv").unlink(missing_ok=True)


@pytest.mark.parametrize("kind", ["never ends", "finds nothing, and never ends", "crosses itself"])
def test_a_view_that_never_ends_is_refused_with_the_reason(commands, tmp_path, monkeypatch, kind):
    monkeypatch.setattr(ask, "LONGEST_STATEMENT", SOON)
    monkeypatch.chdir(tmp_path)
    database(tmp_path, "about", VIEWS[kind])
    code, out, error = commands("results")
    assert (code, out) == ((2, "") if kind != "never ends" else (0, out))
    if code:
        assert f"takes longer than {SOON:g} s" in error


def test_an_answer_that_would_fill_the_memory_is_refused(here, monkeypatch):
    for name, most in (("MOST_CELLS", 3000), ("MOST_TEXT", 3000)):
        with monkeypatch.context() as patch, ask.connect("results/results.sqlite") as db:
            patch.setattr(ask, name, most)
            with pytest.raises(ask.InputError, match="add `limit 1000`"):
                ask.ask(db, ENDLESS + "select i, 'text' from n")
            assert len(ask.ask(db, ENDLESS + "select i, 'text' from n limit 500").rows) == 500


def test_each_statement_has_its_own_time(here, monkeypatch):
    with ask.connect("results/results.sqlite") as db:
        monkeypatch.setattr(ask, "LONGEST_STATEMENT", SOON)
        for _ in range(2):
            with pytest.raises(ask.InputError, match="takes longer"):
                ask.ask(db, ENDLESS + "select i from n where i < 0")
            assert ask.ask(db, "select 1").rows == [(1,)]


@pytest.mark.parametrize("path", ["/dev/zero", "../../../../../../../dev/zero", "pipe.csv", "/etc/passwd"])
def test_verify_reads_nothing_but_files_of_the_results(commands, tmp_path, monkeypatch, path):
    import os

    monkeypatch.chdir(tmp_path)
    (tmp_path / "results").mkdir()
    os.mkfifo(tmp_path / "results/pipe.csv")
    with closing(sqlite3.connect(tmp_path / "results/results.sqlite")) as db, db:
        db.executescript(SCHEMA)
        db.execute("insert into about values ('1', 'test')")
        db.execute("insert into files values (?, 'table', 1, ?)", (path, "0" * 64))
    code, out, _ = commands("verify")
    assert (code, "not a file of results" in out) == (1, True)


@pytest.mark.parametrize("key", ["../../x", "/etc/passwd", "k" * 5000, "a\0b", "a\nb", "", "..", 7, b"x"])
def test_a_key_that_is_none_is_told_of_and_no_file_is_looked_for(commands, tmp_path, monkeypatch, key):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "results").mkdir()
    with closing(sqlite3.connect(tmp_path / "results/results.sqlite")) as db, db:
        db.executescript(SCHEMA.partition("create table points")[0])
        db.execute("create table points (key)")
        db.execute("insert into about values ('1', 'test')")
        db.execute("insert into points values (?)", (key,))
    code, out, error = commands("verify")
    assert (code, error) == ((0 if key == 7 else 1), "")
    assert ("is no key" in out) == (key != 7)


@pytest.mark.parametrize("cell", ["true in 3 of 8 samples", '{"note": 1}', "[]"])
def test_grounds_that_grading_did_not_write_are_refused_by_name(cell):
    row = {"paper": "plain", "id": "A1", "grounds": cell}
    with pytest.raises(InputError, match=r"reproduction.csv: plain/A1: grounds"):
        _graded(row)
