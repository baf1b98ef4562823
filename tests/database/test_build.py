"""Built whole or not at all, and only what changed is read again."""

import shutil
import signal
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest
import workspace
from compare import wrong

from riserstudy.database import build as building
from riserstudy.database.write_study import remove_unused
from riserstudy.dataset.write_dataset import write_dataset
from riserstudy.errors import InputError, SimulationError

DATASETS = 8


def content():
    """Everything in the database but the order in which it was written."""
    with closing(sqlite3.connect(f"file:{workspace.DATABASE}?mode=ro", uri=True)) as db:
        assert db.execute("pragma integrity_check").fetchall() == [("ok",)]
        assert db.execute("pragma foreign_key_check").fetchall() == []
        studies = "select study, caption, kind, axes, rows, scene, engine, path from studies"
        points = "select study, position, key, place, engine, warnings from points"
        values = (
            "select study, position, quantity, statistic, unit, value, s, time, cylinder"
            " from results join points using (point)"
        )
        parameters = (
            "select study, position, path, value, unit, as_written, origin, because"
            " from parameters join points using (point)"
        )
        effects = "select study, position, effect, is_on from effects join points using (point)"
        tables = ["papers", "files", "reads", "rests_on", "numbers_and_claims", "errata"]
        tables += ["figures", "figure_reads"]
        every = [studies, points, values, parameters, effects]
        every += [f"select * from {table}" for table in tables]
        every += ["select name, type from sqlite_master where name not like 'sqlite_%'"]
        every += ["select quantity, statistic, unit from quantities"]
        return [sorted(map(repr, db.execute(asked))) for asked in every]


def test_every_reference_names_its_column(here):
    # browsers of such files follow the name; Datasette shows no table that has a reference without
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        tables = [t for (t,) in db.execute("select name from sqlite_master where type = 'table'")]
        found = [r for t in tables for r in db.execute(f"pragma foreign_key_list({t!r})")]
        assert len(found) > 20
        for _, _, table, _, column, *_ in found:
            names = [row[1] for row in db.execute(f"pragma table_info({table})")]
            assert column in names


def test_nothing_is_read_again_where_nothing_changed(mine):
    before = content()
    assert workspace.built() == (DATASETS, 0)
    assert content() == before


@pytest.mark.long
def test_a_changed_dataset_alone_is_read_again(mine):
    write_dataset(workspace.swing(scale=3.0), workspace.RESULTS / "plain/swing.nc")
    assert workspace.built() == (DATASETS, 1)
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        assert [*wrong(db, workspace.RESULTS)] == []
    changed = content()
    workspace.DATABASE.unlink()
    assert workspace.built() == (DATASETS, DATASETS)
    assert content() == changed


def test_what_was_read_again_is_as_if_built_anew(mine):
    before = content()
    target = workspace.RESULTS / "odd/Order-by_1.nc"
    aside = target.rename(mine / "aside.nc")
    assert workspace.built() == (DATASETS - 1, 0)
    gone = content()
    assert all("Order-by_1" not in row for rows in gone[:5] for row in rows)
    assert gone[2] == [row for row in before[2] if "Order-by_1" not in row]
    aside.rename(target)
    assert workspace.built() == (DATASETS, 1)
    assert content() == before


def test_a_renamed_study_leaves_nothing_behind(mine):
    before = content()
    file = Path("config/studies/plain.yaml")
    text = file.read_text()
    file.write_text(text.replace("  one:", "  single:", 1))
    shutil.move(workspace.RESULTS / "plain/one.nc", workspace.RESULTS / "plain/single.nc")
    assert workspace.built() == (DATASETS, 1)
    after = content()
    assert not any("'plain/one'" in row for row in after[1])
    renamed = sorted(row.replace("'plain/one'", "'plain/single'") for row in before[2])
    assert sorted(after[2]) == renamed


def test_a_changed_caption_needs_no_reading(mine):
    file = Path("config/studies/plain.yaml")
    file.write_text(file.read_text().replace("caption: a single point", "caption: o'ne"))
    assert workspace.built() == (DATASETS, 0)
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        asked = "select caption from studies where study = 'plain/one'"
        assert db.execute(asked).fetchone() == ("o'ne",)


def test_a_paper_that_goes_takes_all_its_own_along(mine):
    sources = workspace.sources()
    left = [f for f in sources.files if f.parent.name != "odd"]
    found = building.build(workspace.DATABASE, building.Sources(sources.config, ["plain"], left))
    assert found == (DATASETS - 2, 0)
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        assert db.execute("select paper from papers").fetchall() == [("plain",)]
        assert db.execute("select count(*) from figures").fetchone() == (1,)
        names = [name for (name,) in db.execute("select name from sqlite_master")]
    assert not any(name.lower().startswith("odd") for name in names)


@pytest.mark.parametrize("how", ["cut", "flipped", "text", "empty", "of other code", "gone"])
def test_a_database_that_is_damaged_or_of_other_code_is_made_anew(mine, how):
    before = content()
    whole = workspace.DATABASE.read_bytes()
    spoiled = bytearray(whole)
    if how == "flipped":  # in the first page, which tells all others
        spoiled[100:300] = bytes(200)
    workspace.DATABASE.write_bytes(
        {"cut": whole[: len(whole) // 2], "text": b"no database", "empty": b""}.get(how, spoiled)
    )
    if how == "of other code":
        with closing(sqlite3.connect(workspace.DATABASE)) as db, db:
            db.execute("update about set builder = 'another'")
    if how == "gone":
        workspace.DATABASE.unlink()
    assert workspace.built() == (DATASETS, DATASETS)
    assert content() == before


def test_a_build_that_fails_leaves_the_old_one_and_nothing_else(mine):
    before, whole = content(), workspace.DATABASE.read_bytes()
    target = workspace.RESULTS / "plain/surge.nc"
    good = target.read_bytes()
    target.write_bytes(good[: len(good) // 3])
    with pytest.raises(InputError, match=r"plain/surge\.nc"):
        workspace.built()
    assert workspace.DATABASE.read_bytes() == whole
    assert [path.name for path in workspace.RESULTS.glob(".*")] == []
    target.write_bytes(good)
    assert workspace.built() == (DATASETS, 0)
    assert content() == before


BUILD = "import sys; sys.path.insert(0, {folder!r}); import workspace; workspace.built()"
#: kills its own process when a function of the builder is called for the nth time
KILLED = """
import os, signal, sys
from riserstudy.database import build
calls = 0
def counted(*args, of=build.{function}):
    global calls
    calls += 1
    if calls == {call}:
        os.kill(os.getpid(), signal.SIGKILL)
    return of(*args)
build.{function} = counted
"""


@pytest.mark.long
@pytest.mark.parametrize(
    "function, call", [("write_study", 1), ("write_study", 6), ("write_papers", 1), ("_run", 2)]
)
def test_a_killed_build_leaves_the_old_one_and_the_next_one_completes(mine, function, call):
    before = content()
    with closing(sqlite3.connect(workspace.DATABASE)) as db, db:
        db.execute("update about set builder = 'another'")  # so that all is read
    old = workspace.DATABASE.read_bytes()
    script = KILLED.format(function=function, call=call)
    script += BUILD.format(folder=str(Path(__file__).parent))
    killed = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert killed.returncode == -signal.SIGKILL, killed.stderr
    assert workspace.DATABASE.read_bytes() == old
    assert [*workspace.RESULTS.glob(".*")] != []
    assert workspace.built() == (DATASETS, DATASETS)
    assert content() == before
    assert [*workspace.RESULTS.glob(".*")] == []


@pytest.mark.long
def test_a_full_disk_is_told_and_the_old_one_stays(mine):
    whole = workspace.DATABASE.read_bytes()
    write_dataset(workspace.swing(scale=3.0), workspace.RESULTS / "plain/swing.nc")
    limit = (
        "import resource, signal; signal.signal(signal.SIGXFSZ, signal.SIG_IGN);"
        f"resource.setrlimit(resource.RLIMIT_FSIZE, ({len(whole) // 2}, -1));"
    )
    command = limit + BUILD.format(folder=str(Path(__file__).parent))
    done = subprocess.run([sys.executable, "-c", command], capture_output=True, text=True)
    assert SimulationError.__name__ in done.stderr
    assert "see whether the disk is full" in done.stderr
    assert workspace.DATABASE.read_bytes() == whole


@pytest.mark.parametrize(
    "broken",
    [
        "insert into points (study, position, key, place, engine, warnings)"
        " values ('no/study', 0, 'k', '', 'e', '')",
        "insert into studies select 'plain/x', paper, name, 'guessed', caption, axes, rows, scene,"
        " tier, accuracy, engine, 'other', 'odd/fig1.png' from studies limit 1",
        "update numbers_and_claims set share = 1.5",
        "update parameter_values set origin = 'hearsay'",
        "update effect_sets set is_on = 2",
        "update files set sha256 = 'short'",
        "insert into figure_reads values ('plain/one', 'plain/none')",
        "delete from papers where paper = 'plain'",
        "insert into result_values values (1, 99999, 0.0, null, null, null)",
    ],
)
def test_what_does_not_fit_together_is_refused_by_the_schema(mine, broken):
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        db.execute("pragma foreign_keys = on")
        with pytest.raises(sqlite3.IntegrityError):
            db.execute(broken)


def test_a_study_takes_its_points_and_their_results_along(mine):
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        db.execute("pragma foreign_keys = on")
        asked = "select count(*) from result_values"
        of_it = f"{asked} join points using (point) where study = 'plain/surge'"
        every, its = (db.execute(sql).fetchone()[0] for sql in (asked, of_it))
        db.execute("delete from studies where study = 'plain/surge'")
        assert its > 0
        assert db.execute(asked).fetchone() == (every - its,)
        assert db.execute("pragma foreign_key_check").fetchall() == []


def test_a_set_that_no_point_has_goes_even_if_some_points_have_none(mine):
    with closing(sqlite3.connect(workspace.DATABASE)) as db:
        kept = db.execute("select * from effect_sets").fetchall()
        db.execute("insert into effect_sets values (99, 'draining', 1, '')")
        db.execute("update points set effect_set = null where point = 1")
        remove_unused(db)
        assert db.execute("select * from effect_sets").fetchall() == kept


@pytest.mark.parametrize(
    "asked, index",
    [
        ("select * from points where key = 'k'", "points_by_key"),
        (
            "select count(*) from result_values where quantity_id = 1 and value > 0",
            "result_values_by_quantity",
        ),
        (
            "select count(*) from parameters where path = 'riser[0].length' and value > 0",
            "parameter_values_by_path",
        ),
        (
            "select point from parameter_sets join point_sets using (parameter_set) where value_id = 3",
            "parameter_sets_by_value",
        ),
    ],
)
def test_frequent_questions_use_an_index(here, asked, index):
    with closing(sqlite3.connect(f"file:{workspace.DATABASE}?mode=ro", uri=True)) as db:
        plan = " ".join(row[3] for row in db.execute(f"explain query plan {asked}"))
    assert index in plan
