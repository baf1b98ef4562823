"""Ways in: the command line and Python read, and nothing that is asked can write."""

import json
import os
import random
import re
import sqlite3
import sys
from contextlib import closing
from csv import DictReader, reader
from pathlib import Path

import pytest
import workspace

from riserstudy import query
from riserstudy.database.ask import ask, connect
from riserstudy.errors import InputError
from riserstudy.study import store


@pytest.fixture
def command(here, commands):
    """Run a command in the workspace; its exit code, output and messages."""
    return commands


def rows(command, *arguments):
    """What a command answers as JSON."""
    code, out, err = command(*arguments, "--json")
    assert (code, err) == (0, "")
    return json.loads(out)


@pytest.mark.long
@pytest.mark.parametrize("asked", [["results"], ["results", "quick"], ["sql", "select 1"]])
def test_json_that_a_file_would_replace_is_refused(command, tmp_path, asked):
    code, out, err = command(*asked, "--json", "--csv", tmp_path / "made.csv")
    assert (code, out) == (2, "")
    assert "--json" in err
    assert not (tmp_path / "made.csv").exists()


@pytest.mark.parametrize("seed", range(4))
def test_objects_hold_each_column_or_none_is_printed(command, seed):
    """Two columns of one name would be one value of an object."""
    draw = random.Random(seed)
    names = [draw.choice("abc") for _ in range(draw.randint(1, 4))]
    statement = f"select {', '.join(f'{k} as {name}' for k, name in enumerate(names))}"
    code, out, err = command("sql", statement, "--json")
    if len(set(names)) == len(names):
        assert json.loads(out) == [{name: k for k, name in enumerate(names)}]
    else:
        assert (code, out) == (2, "")
        assert "two columns have this name" in err


WRITES = [
    "insert into papers values ('x')",
    "update points set wall_seconds = 0",
    "delete from points",
    "drop table points",
    "create table t (a)",
    "create temp table t (a)",
    "create temp view v as select 1",
    "create trigger t after insert on points begin select 1; end",
    "alter table points add column x",
    "attach database 'stolen.sqlite' as other",
    "attach database '/etc/passwd' as other",
    "detach database main",
    "vacuum",
    "vacuum into 'stolen.sqlite'",
    "pragma journal_mode = wal",
    "pragma query_only = 0",
    "pragma user_version = 7",
    "pragma writable_schema = on",
    "pragma table_info(points)",
    "select * from pragma_table_info('points')",
    "select load_extension('libm.so.6')",
    "select writefile('stolen', 'x')",
    "select edit('x')",
    "select fts3_tokenizer('simple')",
    "begin",
    "commit",
    "savepoint s",
    "reindex",
    "analyze",
    "with t as (select 1) insert into papers select 'x' from t",
    "select 1; delete from points",
    "create virtual table v using fts5(a)",
    "",
    "-- nothing",
    "select",
    "select * from no_such_table",
    "select no_such_column from points",
    "select ?",
    "select '\x00",
    "select zeroblob(1 << 40)",
]


@pytest.mark.parametrize("statement", WRITES)
def test_what_does_more_than_read_or_cannot_be_meant_is_refused_in_one_line(command, statement):
    before = Path(workspace.DATABASE).read_bytes()
    around = {*Path().rglob("*")}
    code, out, err = command("sql", statement)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert err.startswith("riserstudy: ")
    with pytest.raises(InputError):
        query(statement)
    assert Path(workspace.DATABASE).read_bytes() == before
    assert {*Path().rglob("*")} == around


def test_a_refused_statement_leads_to_the_page_of_tables(command):
    page = Path(__file__).parents[2] / "docs/results_database.md"
    assert "docs/results_database.md" in command("sql", "delete from points")[2]
    assert page.exists()


CONDITIONS = [
    "1; drop table plain_surge",
    "1) union select key from points --",
    "amplitude > 1) ; --",
    "1 order by 1",
    "x_max > (select load_extension('x'))",
    "no_such > 1",
    "'",
]


@pytest.mark.parametrize("condition", CONDITIONS)
def test_a_condition_that_cannot_be_meant_is_refused(command, condition):
    code, out, err = command("results", "plain/surge", "--where", condition)
    assert (code, out) == (2, "")
    assert "--where" in err


@pytest.mark.parametrize("option", ["--columns", "--sort"])
@pytest.mark.parametrize("name", ["no_such", '"; drop table points; --', "amplitude desc", "*", "1"])
def test_columns_are_names_and_nothing_else(command, option, name):
    code, out, err = command("results", "plain/surge", option, name)
    assert (code, out) == (2, "")
    assert f"no column {name!r}" in err
    assert "amplitude, period" in err


def test_results_lists_every_study_with_its_points_and_size(command):
    found = {row["study"]: row for row in rows(command, "results")}
    assert {study: row["rows"] for study, row in found.items()} == {
        "odd/Order-by_1": 48,
        "odd/order-by_1": 2,
        "plain/surge": 6,
        "plain/meshes": 3,
        "plain/sampled": 4,
        "plain/one": 1,
        "plain/static": 1,
        "plain/swing": 6,
    }
    size = (workspace.RESULTS / "plain/surge.nc").stat().st_size
    assert found["plain/surge"]["MB"] == pytest.approx(size / 1e6)
    assert found["plain/surge"]["simulated (s)"] > 0.0


def test_a_condition_columns_and_an_order_choose_among_the_points_of_a_study(command):
    wanted = ["--columns", "period, x_max,amplitude", "--sort=-x_max,period"]
    found = rows(command, "results", "plain/surge", "--where", "amplitude > 2", *wanted)
    assert [*found[0]] == ["period", "x_max", "amplitude"]
    assert {row["amplitude"] for row in found} == {2.5}
    assert sorted(row["period"] for row in found) == [9.0, 12.0, 15.0]
    values = [row["x_max"] for row in found]
    assert values == sorted(values, reverse=True)
    assert len(set(values)) == 3
    table = rows(command, "results", "plain_surge", "--where", "amplitude > 2 -- and so on", *wanted)
    assert table == found


def test_a_study_is_found_by_its_name_where_no_other_paper_has_it(command):
    assert rows(command, "results", "surge") == rows(command, "results", "plain/surge")
    code, _, err = command("results", "no_such", "--where", "amplitude > 2")
    assert code == 2
    assert "no study 'no_such'" in err


def test_axes_and_results_are_shown_where_no_columns_are_asked_for(command):
    found = rows(command, "results", "plain/surge")[0]
    assert {"amplitude", "period", "x_max", "effective_tension_min"} <= {*found}
    assert not {"wall_seconds", "x_static_max", "key"} & {*found}


def test_a_table_shows_units_and_csv_holds_all_digits(command, tmp_path):
    code, out, _ = command("results", "plain/surge", "--columns", "period,x_max")
    assert code == 0
    assert out.splitlines()[0].split() == ["period", "(s)", "x_max", "(m)"]
    asked = ["results", "plain/surge", "--columns", "x_max"]
    written = f"written: {tmp_path / 'a.csv'}\n"
    assert command(*asked, "--csv", tmp_path / "a.csv")[:2] == (0, written)
    with (tmp_path / "a.csv").open(newline="") as file:
        written = [float(row["x_max (m)"]) for row in DictReader(file)]
    assert written == [row["x_max"] for row in rows(command, *asked)]
    command("results", "plain/surge", "--csv", tmp_path / "all.csv")
    with (tmp_path / "all.csv").open(newline="") as file:
        written = next(reader(file))
    assert written == re.split(r" {2,}", command("results", "plain/surge")[1].splitlines()[0].strip())
    assert "period (s)" in written
    code, _, err = command(*asked, "--csv", tmp_path / "no/such/folder.csv")
    assert (code, "folder.csv" in err) == (2, True)


@pytest.mark.parametrize("options", [["--where", "1"], ["--columns", "x"], ["--sort", "x"]])
def test_options_need_a_study(command, options):
    for words in ([], ["no/study"], ["plain/surge", "plain/one"]):
        code, out, err = command("results", *words, *options)
        assert (code, out) == (2, "")
        assert ("there is no study" if words else "the name of a study is missing") in err


def test_words_find_the_points_that_have_them_all(command):
    found = rows(command, "results", "plain/surge", "amplitude=2.5", "period=9.0")
    (row,) = found
    assert row["study"] == "plain/surge"
    assert store.has(row["key"])
    assert rows(command, "results", row["key"][:20])[0]["key"] == row["key"]


@pytest.mark.parametrize("label", workspace.LABELS)
def test_labels_are_found_as_they_are_written(command, label):
    asked = 'select count(*) as n from "odd_Order-by_1" where "select" = \'{}\''
    (found,) = rows(command, "sql", asked.format(label.replace("'", "''")))
    assert found == {"n": 8}
    assert query('select count(*) from "odd_Order-by_1" where "select" = ?', [label]).iloc[0, 0] == 8


def test_names_that_mean_something_in_sql_are_columns_like_others(command):
    names = "select,group,Key,rowid"
    found = rows(command, "results", "odd/Order-by_1", "--columns", names, "--sort", names)
    assert len(found) == 48
    assert {row["select"] for row in found} == {*workspace.LABELS}
    assert {row["rowid"] for row in found} == {"a", "b"}
    assert len({tuple(row.values()) for row in found}) == 48
    code, out, _ = command("results", "odd/Order-by_1", "--where", '"group" = 2 and "Key" > 0.7')
    assert (code, len(out.splitlines())) == (0, 1 + 12)


def test_names_that_differ_in_case_alone_get_tables_of_their_own(command):
    found = {row["study"]: row["table"] for row in rows(command, "results")}
    assert found["odd/Order-by_1"].lower() != found["odd/order-by_1"].lower()
    assert len(rows(command, "results", "odd/order-by_1")) == 2


def test_texts_of_scenes_and_studies_are_data(here):
    found = query("select study, caption from studies where caption = ?", [workspace.INJECTION])
    assert found["study"].tolist() == ["odd/Order-by_1"]
    assert query("select count(*) as n from points")["n"][0] == 65
    because = query("select distinct because from parameters where because <> ''")["because"]
    assert workspace.INJECTION in set(because)


def test_python_gets_a_table_with_names_and_types(here):
    found = query("select study, rows, 0.5 as half, null as none from studies where rows > ?", [40])
    assert found.to_dict("list") == {"study": ["odd/Order-by_1"], "rows": [48], "half": [0.5], "none": [None]}
    assert query("select 1 as a where 0").columns.tolist() == ["a"]


@pytest.mark.parametrize("content", [None, b"", b"no database", b"SQLite format 3\x00" + bytes(4096)])
def test_no_database_or_another_file_is_told_with_what_to_do(command, tmp_path, content):
    if content is not None:
        (tmp_path / "results.sqlite").write_bytes(content)
    for arguments in (["results"], ["sql", "select 1"], ["verify"]):
        code, out, err = command(*arguments, "--results", tmp_path)
        assert (code, out) == (2, "")
        assert "results.sqlite" in err
        assert "make" in err


def test_the_file_cannot_be_written_through_what_is_opened(here):
    before = workspace.DATABASE.read_bytes()
    with connect(workspace.DATABASE) as db:
        db.set_authorizer(None)
        with pytest.raises(sqlite3.OperationalError, match="readonly"):
            db.execute("delete from points")
    assert workspace.DATABASE.read_bytes() == before


def test_a_reader_keeps_what_it_opened_while_the_database_is_replaced(mine):
    with connect(workspace.DATABASE) as db:
        before = ask(db, "select count(*) from points").rows
        (workspace.RESULTS / "plain/surge.nc").unlink()
        workspace.built()
        assert ask(db, "select count(*) from points").rows == before
    with connect(workspace.DATABASE) as db:
        assert ask(db, "select count(*) from points").rows == [(before[0][0] - 6,)]


def test_a_number_that_json_has_not_is_text(command):
    asked = 'select largest from "plain_swing_over_naïve axis"'
    assert [row["largest"] for row in rows(command, "sql", asked)] == ["inf", 0.0, 1e-308]


def test_a_reader_that_has_enough_is_no_error(here):
    script = "from riserstudy.cli import main; main()"
    first, second = os.pipe()
    os.close(first)
    child = os.posix_spawn(
        sys.executable,
        [sys.executable, "-c", script, "results", "odd/Order-by_1"],
        os.environ,
        file_actions=[(os.POSIX_SPAWN_DUP2, second, 1)],
    )
    os.close(second)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def test_any_program_opens_it_as_it_is(here):
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        views = db.execute("select name from sqlite_master where type = 'view'").fetchall()
        for (view,) in views:
            assert db.execute(f"select count(*) from {view}").fetchone()[0] >= 0
        assert db.execute("select count(*) from results").fetchone()[0] > 0


@pytest.mark.parametrize("seed", range(12))
def test_a_misspelt_name_in_double_quotes_is_no_text(seed, tmp_path):
    """SQLite compares its letters instead, which is true of all rows or of none."""
    draw = random.Random(seed)
    name = "".join(draw.choices(["ö", "select", " ", "'", "--", ";", "[", "]", "`", "x", "/*", "(m)"], k=5))
    with sqlite3.connect(tmp_path / "results.sqlite") as db:
        db.execute("create table about (version)")
        db.execute(f'create table points ("x{name}", text)')
        rows = [(draw.randrange(10), draw.choice(['"', "--", 'say "no"', "[a]"])) for _ in range(9)]
        db.executemany("insert into points values (?, ?)", rows)
    db.close()
    bound, text = draw.randrange(10), rows[0][1]
    name = f"x{name}"
    columns = f'"{name}", "{name}" as "a {name}", [text], text as `b "`'
    found = query(f'select {columns} from points where "{name}" > {bound}', (), tmp_path / "results.sqlite")
    assert [*found.columns] == [name, f"a {name}", "text", 'b "']
    assert len(found) == sum(value > bound for value, _ in rows)
    same = f"select count(*) from points where text = '{text}' -- \"no name\""
    assert query(same, (), tmp_path / "results.sqlite").iat[0, 0] == [t for _, t in rows].count(text)
    for condition in (f'"{name}s" > {bound}', f'"{name}s" < {bound}', f'text = "{name}s"'):
        with pytest.raises(InputError, match="no such column"):
            query(f"select * from points where {condition}", (), tmp_path / "results.sqlite")
