"""The database that the real workflow makes, on the study in small."""

import re
import shutil
import sys
from pathlib import Path

import pytest

from riserstudy import query

sys.path.append(str(Path(__file__).parents[1] / "database"))
from page import QUESTIONS

pytestmark = pytest.mark.long

NAME = "results/results.sqlite"
EMPTY = {2, 3, 4, 6}  # in small nothing is graded, and these risers neither bend nor have joints


@pytest.fixture(scope="module")
def asked(finished, tmp_path_factory):
    """A checkout whose database is made; only to look at."""
    folder = tmp_path_factory.mktemp("asked") / "a checkout"
    shutil.copytree(finished.folder, folder, symlinks=True)
    checkout = type(finished)(folder)
    status, said, complained = checkout.run(NAME)
    assert status == 0, said + complained
    assert "make the results database" in checkout.done()
    assert not any(job.startswith("simulate") for job in checkout.done())
    return checkout


@pytest.mark.parametrize("number, sql, answer", QUESTIONS, ids=lambda of: str(of)[:2])
def test_the_questions_of_the_page_are_answered(asked, number, sql, answer):
    found = query(sql, database=asked / NAME)
    assert found.columns.tolist() == re.split(r"\s{2,}", answer.splitlines()[0].strip())
    assert found.empty == (number in EMPTY)


def test_points_steps_and_files_are_those_of_the_workflow(asked):
    counts = query(
        "select study, count(*) as points, count(distinct key) as keys from points group by study",
        database=asked / NAME,
    )
    assert counts["points"].sum() >= len(asked.stored())
    files = query("select path, kind from files", database=asked / NAME)
    here = {p.relative_to(asked / "results").as_posix() for p in asked.folder.glob("results/*/*.nc")}
    assert {*files["path"][files["kind"] == "dataset"]} == here
    assert {"chang2020/fig14.png", "chang2020/fig14.pdf"} <= {*files["path"]}


def test_it_is_made_again_only_where_something_changed(asked, tmp_path):
    assert "make the results database" not in asked.planned(NAME)
    shutil.copytree(asked.folder, tmp_path / "mine", symlinks=True)
    mine = type(asked)(tmp_path / "mine")
    (mine / NAME).unlink()
    assert mine.planned(NAME) == {"make the results database"}
    shutil.copy(asked / NAME, mine / NAME)
    mine.edit("config/studies/chang2020.yaml", "paper: chang2020", "# edited\npaper: chang2020")
    assert "make the results database" in mine.planned(NAME)


def test_verify_is_content_with_what_the_workflow_made(asked, monkeypatch, commands, tmp_path):
    monkeypatch.setenv("RISERSTUDY_CACHE", str(asked / ".cache"))
    shutil.copytree(asked / "results", tmp_path / "results")
    monkeypatch.chdir(tmp_path)
    assert commands("verify")[1].startswith("0 faults in ")
    sealed = [seal.name for seal in Path("results/.seals").glob("*.*") if seal.is_file()]
    assert "results.sqlite" in sealed
    for name in sealed:
        file = Path("results", name)
        if not file.is_file():
            continue
        whole = file.read_bytes()
        file.write_bytes(whole + b"\n")
        code, said, _ = commands("verify")
        assert code
        assert f"{file}: changed since" in said
        file.write_bytes(whole)
