"""Build the database: files that changed since the last build are read again, all in one transaction.

The new file replaces the old one when it is complete. A reader thus finds either the old or the new file, and
a killed run leaves one of them. The database has one writer, the last job of the workflow.
"""

from __future__ import annotations

import os
import shutil
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

from riserstudy.database.sources import File, Sources, described
from riserstudy.database.wide_table import facts_of_points
from riserstudy.database.write_papers import datasets_of, remove_papers, studies_of, write_papers
from riserstudy.database.write_parameters import Values
from riserstudy.database.write_study import marks, remove_study, remove_unused, write_study
from riserstudy.errors import SimulationError
from riserstudy.files.digests import dependencies, digest

DATA_FILES = ("schema.sql",)
SCHEMA = Path(__file__).with_name(DATA_FILES[0])
# line of the schema after which the columns of the facts are inserted
FACTS = "    -- facts of the run\n"
#: created after all rows are inserted, which is three times as fast
INDEXES = """
create index if not exists points_by_key on points (key);
create index if not exists result_values_by_quantity on result_values (quantity_id);
create index if not exists parameter_sets_by_value on parameter_sets (value_id, parameter_set);
create index if not exists point_sets_by_set on point_sets (parameter_set, point);
pragma analysis_limit = 400;
analyze;
"""
OF_A_DISK = ("SQLITE_FULL", "SQLITE_IOERR", "SQLITE_CANTOPEN")


class Built(NamedTuple):
    """Number of datasets, and number of datasets that were read again."""

    datasets: int
    read: int


def build(target: Path, sources: Sources) -> Built:
    """Make the database of a results folder, or update it.

    Raises SimulationError when the database cannot be written, for example on a full disk.
    """
    try:
        with _replacing(target) as db:
            built = _update(db, sources, target.parent)
    except (OSError, sqlite3.OperationalError) as error:
        if not getattr(error, "sqlite_errorname", OF_A_DISK[0]).startswith(OF_A_DISK):
            raise
        raise SimulationError(f"{target} cannot be written: {error}; see whether the disk is full") from error
    return built


@contextmanager
def _replacing(target: Path) -> Iterator[sqlite3.Connection]:
    """Yield a copy of the database, or an empty one, which replaces the database if no error occurs."""
    partial = target.with_name(f".{target.name}.{os.getpid()}")
    for left in target.parent.glob(f".{target.name}.*"):
        left.unlink()  # left by a killed run: the database has only one writer
    try:
        with suppress(FileNotFoundError):
            shutil.copyfile(target, partial)
        if not _is_ours(partial):
            partial.unlink(missing_ok=True)
        with closing(sqlite3.connect(partial, isolation_level=None)) as db:
            # nobody ever reads a half-written file: no journal and no waiting for the disk are needed
            db.executescript(
                "pragma journal_mode = off; pragma synchronous = off; pragma foreign_keys = on;"
                "pragma locking_mode = exclusive; pragma cache_size = -200000; begin;"
            )
            yield db
            db.execute("commit")
        partial.replace(target)
    finally:
        partial.unlink(missing_ok=True)


def _is_ours(path: Path) -> bool:
    """Return whether a file is a complete database that the present code wrote."""
    try:
        with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as db:
            whole = db.execute("pragma quick_check").fetchall() == [("ok",)]
            return whole and db.execute("select builder from about").fetchall() == [(builder(),)]
    except sqlite3.Error:
        return False


def schema() -> str:
    """Return the statements that make an empty database, with a column for each fact about runs."""
    facts = [
        f"    {fact.name} {fact.about.kind}{' not null' if fact.about.kind == 'text' else ''},"
        f" -- {', '.join(filter(None, (fact.about.long_name, fact.about.unit)))}\n"
        for fact in facts_of_points()
    ]
    return SCHEMA.read_text("utf-8").replace(FACTS, "".join(facts))


def builder() -> str:
    """Digest of the code that builds the database."""
    return digest(dependencies(__name__))


def _update(db: sqlite3.Connection, sources: Sources, folder: Path) -> Built:
    if not db.execute("select 1 from sqlite_master").fetchone():
        _run(db, schema())
        db.execute("insert into about values (?, ?)", (version("riserstudy"), builder()))
    files = [described(path, folder) for path in sources.files]
    before: dict[str, str] = dict(db.execute("select path, sha256 from files").fetchall())
    now = {file.path: file.sha256 for file in files}
    changed = {path for path in {**before, **now} if before.get(path) != now.get(path)}
    study_files = studies_of(sources)
    wanted = {a.path: a for a in datasets_of(study_files) if a.path in now}
    remove_papers(db)
    _remove(db, changed, wanted.keys())
    _write_files(db, files, sources)
    held = {path for (path,) in db.execute("select path from studies")}
    new = [about for path, about in wanted.items() if path not in held]
    for about in wanted.values():
        row = (about.caption, about.kind, about.study)
        db.execute("update studies set caption = ?, kind = ? where study = ?", row)
    values = Values(db)
    for about in new:
        write_study(db, about, folder, values)
    write_papers(db, sources, study_files, files)
    _run(db, INDEXES)
    return Built(len(wanted), len(new))


def _remove(db: sqlite3.Connection, changed: set[str], wanted: object) -> None:
    """Delete studies whose dataset has changed or is no longer wanted."""
    held = db.execute("select study, path from studies").fetchall()
    outdated = [study for study, path in held if path in changed or path not in wanted]  # type: ignore[operator]
    for study in outdated:
        remove_study(db, study)
    if outdated:
        remove_unused(db)


def _write_files(db: sqlite3.Connection, files: list[File], sources: Sources) -> None:
    db.executemany("insert or ignore into papers values (?)", [(p,) for p in sources.papers])
    kept = marks(len(sources.papers))
    statement = "insert into files values (?, ?, ?, ?) on conflict (path) do update set"
    statement += " kind = excluded.kind, bytes = excluded.bytes, sha256 = excluded.sha256"
    db.executemany(statement, files)
    now = {file.path for file in files}
    every = db.execute("select path from files").fetchall()
    db.executemany("delete from files where path = ?", [p for p in every if p[0] not in now])
    db.execute(f"delete from papers where paper not in ({kept})", sources.papers)


def _run(db: sqlite3.Connection, script: str) -> None:
    """Run statements one by one: ``executescript`` would first end the transaction."""
    statement = ""
    for line in script.splitlines(keepends=True):
        statement += line
        if sqlite3.complete_statement(statement):
            db.execute(statement)
            statement = ""
