"""A database that was built before its files changed is told from one that is up to date."""

import random
import sqlite3
from contextlib import closing

import pytest
import workspace

from riserstudy import query
from riserstudy.jobs.seals import seal

ASKED = [
    ("results",),
    ("results", "plain/surge"),
    ("results", "surge"),
    ("sql", "select count(*) from points"),
]


def names():
    """Files that the database describes, datasets and others."""
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        return sorted(path for (path,) in db.execute("select path from files"))


def sealed():
    """The files with their seals, as after a run."""
    seal(*(workspace.RESULTS / name for name in names()), workspace.DATABASE)


@pytest.mark.parametrize("with_seals", [True, False])
@pytest.mark.parametrize("asked", ASKED)
def test_nothing_is_told_where_the_files_are_those_of_the_database(mine, commands, asked, with_seals):
    if with_seals:
        sealed()
    code, _, said = commands(*asked)
    assert (code, said) == (0, "")


@pytest.mark.parametrize("seed", range(12))
def test_files_that_a_killed_run_made_again_deleted_or_added_are_named(mine, commands, seed):
    draw = random.Random(seed)
    if seed % 2:
        sealed()
    name = draw.choice(names())
    file = workspace.RESULTS / name
    if seed % 3 == 0:  # a job removes its files when it starts
        file.unlink()
    elif seed % 3 == 1:  # of the same size
        content = bytearray(file.read_bytes())
        content[draw.randrange(len(content))] ^= 1
        file.write_bytes(content)
    else:
        file = workspace.RESULTS / "plain/added.nc"
        file.write_bytes(b"new")
    if file.exists() and (seed % 2 or file.name == "added.nc"):
        seal(file)
    for asked in ASKED:
        code, _, said = commands(*asked)
        assert code == 0
        assert said.count("\n") == 1
        assert f"note: {workspace.DATABASE} does not match {file}, changed or deleted" in said
    with pytest.warns(UserWarning, match="does not match"):
        query("select 1")


def test_all_changes_are_counted(mine, commands):
    sealed()
    for name in names()[:3]:
        (workspace.RESULTS / name).unlink()
    assert "and 2 more, changed or deleted" in commands("results")[2]


def test_a_database_that_was_copied_alone_is_no_old_one(mine, commands, tmp_path):
    (tmp_path / "alone").mkdir()
    workspace.DATABASE.rename(tmp_path / "alone/results.sqlite")
    code, _, said = commands("results", "--results", tmp_path / "alone")
    assert (code, said) == (0, "")


@pytest.mark.parametrize("path", ["../stranger", "/etc/passwd", "", "plain/../../x"])
def test_paths_out_of_the_folder_are_left_alone(mine, commands, path):
    with closing(sqlite3.connect(workspace.DATABASE)) as db, db:
        db.execute("insert into files values (?, 'table', 1, ?)", [path, "x" * 64])
    assert commands("results")[::2] == (0, "")
