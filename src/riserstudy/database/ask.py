"""Query the database with statements that only read.

A database may come from anybody. Its tables may be views, and the first query then already runs statements of
somebody else. From the first query on, only reading is allowed, and time, texts and answers are limited.
"""

from __future__ import annotations

import re
import sqlite3
import time as clock
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any, NamedTuple

from riserstudy.errors import InputError

NAME = "results.sqlite"
DATABASE = Path("results") / NAME
READS = frozenset(
    (sqlite3.SQLITE_SELECT, sqlite3.SQLITE_READ, sqlite3.SQLITE_FUNCTION, sqlite3.SQLITE_RECURSIVE)
)
#: functions that have effects outside the database
REFUSED = frozenset(("load_extension", "fts3_tokenizer"))
#: steps of a statement between checks for an interrupt and for its time limit; costs a quarter of the time
STEPS_BETWEEN_CHECKS = 100
LONGEST_STATEMENT = 60.0  # longest time of a statement (s)
MOST_CELLS = 50_000_000  # most cells of an answer
MOST_TEXT = 1_000_000_000  # most characters and bytes of an answer
#: a text in single quotes, a comment, a name in backticks or brackets, or one in double quotes: the group
QUOTED = re.compile(
    r"""'(?:[^']|'')*'|--[^\n]*|/\*.*?\*/|`(?:[^`]|``)*`|\[[^\]]*\]|"((?:[^"]|"")*)\"""", re.DOTALL
)
#: limits of operations that need much time or memory within one step, where nothing can interrupt them
LIMITS = {
    sqlite3.SQLITE_LIMIT_LENGTH: 1_000_000,  # bytes of a text or a row
    sqlite3.SQLITE_LIMIT_LIKE_PATTERN_LENGTH: 1000,
}


class Answer(NamedTuple):
    """Names of the columns, and the rows."""

    columns: list[str]
    rows: list[tuple[Any, ...]]


class Reader(sqlite3.Connection):
    """A connection that ends each statement after ``LONGEST_STATEMENT`` seconds at the latest."""

    _end = float("inf")

    def execute(self, *statement: Any) -> sqlite3.Cursor:
        """Execute a statement; its time starts here."""
        self._end = clock.monotonic() + LONGEST_STATEMENT
        return super().execute(*statement)

    def is_late(self) -> bool:
        """Return whether the latest statement has exceeded its time."""
        return clock.monotonic() > self._end


@contextmanager
def connect(database: str | Path = DATABASE) -> Iterator[sqlite3.Connection]:
    """Open the database for reading only: both the file and the statements are restricted.

    Raises InputError when the database does not exist or is damaged.
    """
    path = Path(database)
    if not path.is_file():
        found = "the results database does not exist"
        raise InputError(path, "", found, "write it with `make study` or `snakemake`")
    # the file is never changed in place: a new file replaces it
    address = f"{path.resolve().as_uri()}?mode=ro&immutable=1"
    try:
        with closing(sqlite3.connect(address, uri=True, factory=Reader)) as db:
            for category, most in LIMITS.items():
                db.setlimit(category, most)
            db.set_authorizer(_only_reads)
            db.set_progress_handler(db.is_late, STEPS_BETWEEN_CHECKS)
            db.execute("select * from about").fetchone()  # fails if the file is not such a database
            yield db
    except sqlite3.DatabaseError as error:
        found = f"the file is damaged, or is not a results database ({_reason(error)})"
        allowed = "delete it; the next `make study` writes it again"
        raise InputError(path, "", found, allowed) from None


def _reason(error: Exception) -> str:
    """Return the reason why a statement failed."""
    if getattr(error, "sqlite_errorname", "") == "SQLITE_INTERRUPT":
        return f"takes longer than {LONGEST_STATEMENT:g} s"
    return str(error)


def _only_reads(action: int, first: str | None, second: str | None, *_: str | None) -> int:
    refused = action == sqlite3.SQLITE_FUNCTION and second in REFUSED
    return sqlite3.SQLITE_OK if action in READS and not refused else sqlite3.SQLITE_DENY


STATEMENT = "write one `select ...`; docs/results_database.md lists tables and columns"


def ask(
    db: sqlite3.Connection, sql: str, values: Sequence[Any] = (), where: str = "sql", allowed: str = STATEMENT
) -> Answer:
    """Return the answer to a statement; ``where`` names the statement in errors, ``allowed`` the remedy.

    Raises InputError when it is not a single statement that only reads, or names a table or column that does
    not exist.
    """
    try:
        cursor = db.execute(_with_names(sql), values)
        rows = _rows(cursor, where)
    except (sqlite3.OperationalError, sqlite3.ProgrammingError, sqlite3.DataError) as error:
        raise InputError(where, "", _reason(error), allowed) from None
    except sqlite3.DatabaseError as error:
        if getattr(error, "sqlite_errorname", "") != "SQLITE_AUTH":
            raise
        raise InputError(where, "", "this statement does more than read", allowed) from None
    except (sqlite3.Warning, ValueError, OverflowError) as error:
        raise InputError(where, "", str(error), allowed) from None
    if cursor.description is None:
        raise InputError(where, "", "this is not a query", allowed)
    return Answer([column[0] for column in cursor.description], rows)


def rows_by_name(db: sqlite3.Connection, sql: str) -> Iterator[dict[str, Any]]:
    """Yield the rows of a statement of our own, one after another: there may be a million."""
    cursor = db.execute(sql)
    names = [column[0] for column in cursor.description]
    for row in cursor:
        yield dict(zip(names, row, strict=True))


def _with_names(sql: str) -> str:
    """The statement with its names in backticks instead of double quotes.

    Where there is no such column SQLite takes ``"name"`` for a text, and a condition on a misspelt column is
    then true everywhere, or nowhere. It never does so with a name in backticks.
    """

    def in_backticks(found: re.Match[str]) -> str:
        if found[1] is None:
            return found[0]
        return "`" + found[1].replace('""', '"').replace("`", "``") + "`"

    return QUOTED.sub(in_backticks, sql)


def _rows(cursor: sqlite3.Cursor, where: str) -> list[tuple[Any, ...]]:
    """Return all rows of an answer; refuse an answer that is too large for the memory."""
    rows: list[tuple[Any, ...]] = []
    text = 0
    for row in cursor:
        rows.append(row)
        text += sum(len(cell) for cell in row if isinstance(cell, str | bytes))
        if len(rows) * len(row) > MOST_CELLS or text > MOST_TEXT:
            found = f"the answer has more than {MOST_CELLS} cells or {MOST_TEXT} characters"
            raise InputError(where, "", found, "select fewer columns, or add `limit 1000`")
    return rows
