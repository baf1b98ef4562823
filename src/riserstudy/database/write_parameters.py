"""Parameters of the points of a study as rows: each value occurs once for all studies and points.

The values that one axis sets are common to all points at the same place on it. Such a set of values is stored
once, and points refer to it.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable
from itertools import repeat

import numpy as np
from numpy.typing import NDArray

from riserstudy.database.parameters import Parameter, Varied


class Values:
    """Values of parameters in a database, with their numbers."""

    def __init__(self, db: sqlite3.Connection):
        self._db = db
        self._paths = dict(db.execute("select path, path_id from paths").fetchall())
        statement = "select path, value, unit, as_written, origin, because, value_id"
        rows = db.execute(f"{statement} from paths join parameter_values using (path_id)")
        self._numbers = {Parameter(*row[:-1]): row[-1] for row in rows}
        self._next = max(self._numbers.values(), default=0) + 1
        statement = "select coalesce(max(parameter_set), 0) + 1 from point_sets"
        self._next_set: int = db.execute(statement).fetchone()[0]

    def numbers(self, parameters: Iterable[Parameter]) -> list[int]:
        """Return the numbers of values; new values are inserted."""
        wanted = [*parameters]
        new = [one for one in dict.fromkeys(wanted) if one not in self._numbers]
        self._numbers.update(zip(new, range(self._next, self._next + len(new)), strict=True))
        self._next += len(new)
        for path in dict.fromkeys(one.path for one in new):
            if path not in self._paths:
                row = "insert into paths (path) values (?)"
                self._paths[path] = self._db.execute(row, (path,)).lastrowid
        rows = ((self._numbers[one], self._paths[one.path], *one[1:]) for one in new)
        self._db.executemany("insert into parameter_values values (?, ?, ?, ?, ?, ?, ?)", rows)
        return [self._numbers[one] for one in wanted]

    def new_sets(self, count: int) -> NDArray[np.int64]:
        """Return numbers for the given count of new sets, (count,)."""
        self._next_set += count
        return np.arange(self._next_set - count, self._next_set)


def write_same(db: sqlite3.Connection, values: Values, study: str, same: Iterable[Parameter]) -> None:
    """Insert the parameters that are equal at all points of a study."""
    pairs = zip(repeat(study), values.numbers(same), strict=False)  # the repeated item has no end
    db.executemany("insert or ignore into study_parameters values (?, ?)", pairs)


def write_varied(
    db: sqlite3.Connection, values: Values, study: str, first: int, varied: Iterable[Varied]
) -> None:
    """Insert the parameters that vary over the points of a study; the points are numbered from ``first``."""
    by_axes: dict[tuple[int, ...], list[NDArray[np.int64]]] = {}
    for one in varied:
        over = _axes(one.at)
        reduced = one.at[tuple(slice(None) if k in over else 0 for k in range(one.at.ndim))]
        by_axes.setdefault(over, []).append(_numbers(values, one.values, reduced.ravel()))
        shape = one.at.shape
    for over, columns in by_axes.items():
        if not over:  # an axis sets the same value everywhere
            pairs = ((study, int(column[0])) for column in columns if column[0] >= 0)
            db.executemany("insert or ignore into study_parameters values (?, ?)", pairs)
            continue
        sets = values.new_sets(len(columns[0]))
        rows = np.stack([np.repeat(sets, len(columns)), np.stack(columns, 1).ravel()])
        rows = rows[:, rows[1] >= 0]
        _insert(db, "parameter_sets", rows)
        own = sets.reshape([n if k in over else 1 for k, n in enumerate(shape)])
        of_points = np.broadcast_to(own, shape).ravel()
        _insert(db, "point_sets", np.stack([np.arange(len(of_points)) + first, of_points]))


def _axes(at: NDArray[np.int64]) -> tuple[int, ...]:
    """Return the axes along which numbers differ."""
    return tuple(k for k in range(at.ndim) if (at != at.take([0], axis=k)).any())


def _numbers(values: Values, numbered: dict[Parameter, int], at: NDArray[np.int64]) -> NDArray[np.int64]:
    """Convert numbers within the study to numbers in the database; -1 (absent) stays -1."""
    used = np.isin(np.arange(len(numbered)), at)
    some = [parameter for parameter, number in numbered.items() if used[number]]
    numbers = np.full(len(numbered) + 1, -1)  # the last one is for absent values
    numbers[[numbered[one] for one in some]] = values.numbers(some)
    found: NDArray[np.int64] = numbers[at]
    return found


def _insert(db: sqlite3.Connection, table: str, columns: NDArray[np.int64]) -> None:
    """Insert rows of two numbers, given as columns; a value that a set has twice is inserted once."""
    rows = zip(*columns.tolist(), strict=True)
    db.executemany(f"insert or ignore into {table} values (?, ?)", rows)
