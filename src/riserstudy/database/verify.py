"""Check that files and points are the same as when the database was made."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import NamedTuple

from riserstudy.database.ask import ask, connect
from riserstudy.database.sources import KINDS, described
from riserstudy.errors import InputError, printable
from riserstudy.files.seals import SEALS, fits_seal
from riserstudy.study import store

_KEY = re.compile(r"[0-9a-z]{1,64}")  # key of a stored point, which is the name of its file


class Verified(NamedTuple):
    """Numbers of checked files and points, and differences, one line each; missing points may be correct."""

    files: int
    points: int
    wrong: list[str]
    missing: int


def verify(database: Path) -> Verified:
    """Compare every file with its digest, and every stored point with its seal.

    Raises InputError when the database does not exist or cannot be read.
    """
    with connect(database) as db:
        db.set_authorizer(None)  # the authorizer would refuse the next statement
        faults = [fault for (fault,) in db.execute("pragma integrity_check") if fault != "ok"]
        wrong = [f"{database}: {fault}" for fault in faults]
        wrong += [f"{database}: {row}" for row in db.execute("pragma foreign_key_check")]
        recorded = ask(db, "select path, sha256 from files").rows
        files = {str(path): str(digest) for path, digest in recorded}
        keys = [str(key) for (key,) in ask(db, "select distinct key from points").rows]
    wrong += [*_sealed(database.parent, files), *_files(database.parent, files)]
    wrong += [f"{database}: {printable(repr(key))} is no key" for key in keys if not _KEY.fullmatch(key)]
    keys = [key for key in keys if _KEY.fullmatch(key)]
    damaged = [key for key in keys if store.has(key) and store.about(key) is None]
    wrong += [f"point {key}: damaged; the next run that needs it simulates it again" for key in damaged]
    missing = sum(not store.has(key) for key in keys)
    return Verified(len(files), len(keys), wrong, missing)


def _sealed(folder: Path, files: Collection[str]) -> Iterator[str]:
    """Yield a message if the database, the report or a table of all papers differs from what its job wrote.

    These files are not in the database. A file made by hand has no seal.
    """
    for seal in sorted((folder / SEALS).glob("*.*")):
        file = folder / seal.name
        if seal.is_file() and file.is_file() and seal.name not in files and not fits_seal(file, folder):
            yield f"{file}: changed since it was made; the next run makes it again"


def _files(folder: Path, files: dict[str, str]) -> Iterator[str]:
    for path, digest in files.items():
        try:
            same = described(folder / path, folder).sha256 == digest
        except InputError as error:
            yield f"{folder / path}: {error.found}"
            continue
        if not same:
            yield f"{folder / path}: changed since the database was made"
    parts = [Path(path).parts for path in files]
    papers = {ways[0] for ways in parts if len(ways) == 2} - {"..", "/"}
    for file in sorted(file for paper in papers for file in (folder / paper).glob("*")):
        known = file.relative_to(folder).as_posix() in files
        if file.suffix in KINDS and file.suffix != ".csv" and not known:
            yield f"{file}: not in the database"
