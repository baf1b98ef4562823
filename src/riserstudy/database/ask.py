"""Ask the database: statements that read, and nothing else."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from riserstudy.errors import InputError

if TYPE_CHECKING:
    import pandas as pd

NAME = "results.sqlite"
DATABASE = Path("results") / NAME
READS = frozenset(
    (sqlite3.SQLITE_SELECT, sqlite3.SQLITE_READ, sqlite3.SQLITE_FUNCTION, sqlite3.SQLITE_RECURSIVE)
)
#: functions that reach beyond the database
REFUSED = frozenset(("load_extension", "fts3_tokenizer"))
AT_EASE = 100_000  # steps of a statement after which an interrupt is looked for


class Answer(NamedTuple):
    """Names of columns, and rows."""

    columns: list[str]
    rows: list[tuple[Any, ...]]


@contextmanager
def opened(database: str | Path = DATABASE) -> Iterator[sqlite3.Connection]:
    """The database, which can only be read: the file as well as what statements may do.

    Raises
    ------
    InputError
        When there is none, or it is damaged.
    """
    path = Path(database)
    if not path.is_file():
        raise InputError(path, "", "no results database", "make it by `make study`, or `snakemake`")
    # never changed in place: a new file takes its place
    address = f"{path.resolve().as_uri()}?mode=ro&immutable=1"
    try:
        with closing(sqlite3.connect(address, uri=True)) as db:
            db.execute("select * from about")  # whether it is one
            db.set_authorizer(_only_reads)
            db.set_progress_handler(lambda: 0, AT_EASE)
            yield db
    except sqlite3.DatabaseError as error:
        if error.__class__ is not sqlite3.DatabaseError and "no such table: about" not in str(
            error
        ):
            raise
        found = f"damaged, or no results database ({error})"
        raise InputError(path, "", found, "delete it; the next run makes it anew") from None


def _only_reads(action: int, first: str | None, second: str | None, *_: str | None) -> int:
    refused = action == sqlite3.SQLITE_FUNCTION and second in REFUSED
    return sqlite3.SQLITE_OK if action in READS and not refused else sqlite3.SQLITE_DENY


def ask(db: sqlite3.Connection, sql: str, values: Sequence[Any] = (), where: str = "sql") -> Answer:
    """What a statement finds; ``where`` names it in errors.

    Raises
    ------
    InputError
        When it is no single statement that reads, or asks for what is not there.
    """
    allowed = "allowed is one `select ...`; tables and columns stand in docs/results_database.md"
    try:
        cursor = db.execute(sql, values)
        rows = cursor.fetchall()
    except (sqlite3.OperationalError, sqlite3.ProgrammingError, sqlite3.DataError) as error:
        raise InputError(where, "", str(error), allowed) from None
    except sqlite3.DatabaseError as error:
        if getattr(error, "sqlite_errorname", "") != "SQLITE_AUTH":
            raise
        raise InputError(where, "", "more than reading", allowed) from None
    except (sqlite3.Warning, ValueError, OverflowError) as error:
        raise InputError(where, "", str(error), allowed) from None
    if cursor.description is None:
        raise InputError(where, "", "nothing that can be asked", allowed)
    return Answer([column[0] for column in cursor.description], rows)


def query(sql: str, values: Sequence[Any] = (), database: str | Path = DATABASE) -> pd.DataFrame:
    """What a statement finds in the results database.

    Parameters
    ----------
    sql : str
        One statement that reads, with a ``?`` for each of ``values``.
    values : sequence
        What stands for the question marks, in their order.
    database : str or Path
        The database's file.

    Returns
    -------
    pandas.DataFrame
        A column for each that the statement selects, a row for each that it finds.

    Raises
    ------
    InputError
        When there is no database, or the statement cannot be meant or does more than read.
    """
    import pandas as pd

    with opened(database) as db:
        answer = ask(db, sql, values)
    return pd.DataFrame(answer.rows, columns=pd.Index(answer.columns))
