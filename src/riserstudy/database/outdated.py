"""Files of a results folder that are not as they were when the database was built."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from pathlib import Path

from riserstudy.database.ask import ask
from riserstudy.errors import InputError, printable
from riserstudy.files.seals import SEALS
from riserstudy.files.whole import sha256_of


def outdated(db: sqlite3.Connection, database: Path) -> str:
    """Return a message about files that changed after the database was built, or an empty text.

    A run that was killed, or that makes only one file, leaves new datasets with the former database. Recorded
    checksums of files are compared; the content of a file is read only if it has no recorded checksum.
    """
    try:
        changed = sorted(_changed(db, database))
    except InputError:  # it does not list its files: not a database of this package
        return ""
    if not changed:
        return ""
    more = f" and {len(changed) - 1} more" if len(changed) > 1 else ""
    return (
        f"{database} does not match {printable(changed[0])}{more}, changed or deleted after it was "
        "built; run the study, which builds it again"
    )


def _changed(db: sqlite3.Connection, database: Path) -> Iterator[Path]:
    """Yield files that were changed, added or deleted."""
    folder, built = database.parent, database.stat().st_mtime
    rows = ask(db, "select path, bytes, sha256 from files").rows
    rows = [row for row in rows if _is_inside(Path(str(row[0])))]
    known = {str(path): (size, str(digest)) for path, size, digest in rows}
    if not any((folder / path).exists() for path in known):
        return  # the database was copied without its files
    for path, (size, digest) in known.items():
        file, seal = folder / path, folder / SEALS / path
        if not file.is_file() or file.stat().st_size != size:
            yield file
        elif seal.is_file():
            if seal.read_bytes()[: len(digest)] != digest.encode():
                yield file
        elif file.stat().st_mtime > built and sha256_of(file) != digest:
            yield file
    papers = {Path(path).parts[0] for path in known}
    for seal in (file for paper in papers for file in (folder / SEALS / paper).glob("*.nc")):
        name = seal.relative_to(folder / SEALS)
        if name.as_posix() not in known and (folder / name).is_file():
            yield folder / name


def _is_inside(path: Path) -> bool:
    """Return whether a path stays in its folder: a database may come from anybody."""
    return bool(path.parts) and not path.is_absolute() and ".." not in path.parts
