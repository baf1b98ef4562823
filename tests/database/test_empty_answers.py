"""Words and options of ``results`` that find nothing are named, and files of jobs are not replaced."""

import json
import re
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest


@pytest.mark.parametrize("words", [["nosuch"], ["no/study"], ["no such word", "at all"]])
@pytest.mark.parametrize("how", [[], ["--json"]])
def test_words_without_a_point_are_named(here, commands, words, how):
    code, out, err = commands("results", *words, *how)
    assert code == 0
    assert json.loads(out) == [] if how else len(out.splitlines()) == 1
    assert all(repr(word) in err for word in words)
    assert ("no study has this name" in err) == (len(words) == 1)


@pytest.mark.parametrize("option", ["--where", "--columns", "--sort"])
@pytest.mark.parametrize("text", ["", "  "])
def test_an_empty_text_is_refused(here, commands, option, text):
    code, out, err = commands("results", "plain/surge", option, text)
    assert (code, out) == (2, "")
    assert f"{option}: {text!r}: the text is empty" in err


@pytest.mark.parametrize("name", ["margins.csv", "reproduction.csv", "errata.csv", "paper/fig01.csv"])
@pytest.mark.parametrize("asked", [["results"], ["sql", "select 1 as a"]])
def test_a_file_that_a_job_made_is_not_replaced(here, commands, name, asked):
    file, seal = Path("results") / name, Path("results/.seals") / name
    was = {path: path.read_bytes() if path.exists() else None for path in (file, seal)}
    try:
        for path in (file, seal):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("made by a job\n")
        code, out, err = commands(*asked, "--csv", file)
        assert (code, out) == (2, "")
        assert re.search(re.escape(file.name), err)
        assert file.read_text() == "made by a job\n"
    finally:
        for path, content in was.items():
            path.unlink()
            if content is not None:
                path.write_bytes(content)


def test_a_dataset_that_does_not_exist_is_named_as_such(here, commands):
    code, out, err = commands("rerun", "nosuch.nc")
    assert (code, out) == (2, "")
    assert "nosuch.nc: there is no such file" in err


@pytest.mark.parametrize("how", [[], ["--json"]])
def test_a_condition_that_no_point_meets_has_no_note(here, commands, how):
    code, out, err = commands("results", "plain/surge", "--where", "amplitude > 1e9", *how)
    assert (code, err) == (0, "")
    assert json.loads(out) == [] if how else len(out.splitlines()) == 1


@pytest.mark.parametrize("condition", ["nosuch > 3", 'amplitude = "two"'])
def test_a_condition_with_an_unknown_name_lists_the_columns(here, commands, condition):
    code, out, err = commands("results", "plain/surge", "--where", condition)
    assert (code, out) == (2, "")
    assert "single quotes" in err
    assert "amplitude" in err.partition("columns: ")[2]
    assert "select" not in err


@pytest.mark.parametrize("minus", ["", "-"])
def test_missing_values_are_last_in_both_orders(here, commands, minus):
    tried = 0
    with closing(sqlite3.connect("results/results.sqlite")) as db:
        named = db.execute("select table_name, column_name from columns").fetchall()
        for table, column in named:
            values = [one for (one,) in db.execute(f'select "{column}" from "{table}"')]
            known = [one for one in values if one is not None]
            if len({*known}) < 2 or len(known) == len(values) or not isinstance(known[0], float | int):
                continue
            code, out, _ = commands(
                "results", table, "--columns", column, f"--sort={minus}{column}", "--json"
            )
            assert code == 0
            found = [row[column] for row in json.loads(out)]
            ordered = sorted(known, reverse=bool(minus))
            assert found == [*ordered, *[None] * (len(values) - len(known))], (table, column)
            tried += 1
            if tried == 5:
                return
    assert tried, "no column has missing values: this tests nothing"
