"""Words and options of ``results`` that find nothing are named, and files of jobs are not replaced."""

import json
import re
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
