"""The answer to an SQL query as a table of pandas, with a warning about results that changed."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from riserstudy.database.ask import DATABASE, ask, connect
from riserstudy.database.outdated import outdated

if TYPE_CHECKING:
    import pandas as pd


def query(sql: str, values: Sequence[Any] = (), database: str | Path = DATABASE) -> pd.DataFrame:
    """Run an SQL query on the results database. A warning states if results changed after it was built.

    Parameters
    ----------
    sql : str
        One SQL statement that only reads, with a ``?`` for each of ``values``.
    values : sequence
        Values that replace the question marks, in their order.
    database : str or Path
        File of the results database.

    Returns
    -------
    pandas.DataFrame
        The selected columns and rows.

    Raises
    ------
    InputError
        When the database does not exist, or the statement is invalid, does not only read, or finds too much.
    """
    import pandas as pd

    with connect(database) as db:
        if note := outdated(db, Path(database)):
            warnings.warn(note, stacklevel=2)
        answer = ask(db, sql, values)
    return pd.DataFrame(answer.rows, columns=pd.Index(answer.columns))
