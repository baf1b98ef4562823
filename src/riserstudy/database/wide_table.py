"""The wide table of a dataset: one row per cell of its grid, with axes and statistics as columns."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from numpy.typing import NDArray

from riserstudy.database.names import Names, quoted
from riserstudy.database.read_dataset import Grid
from riserstudy.dataset.extremes import Statistic
from riserstudy.records.facts import PointColumn, point_columns
from riserstudy.scene.fields import in_si

ASSUMED = "assumed_"
MANY = 20_000  # values of a column that are converted to Python numbers at a time
TYPES = {"i": "integer", "u": "integer", "f": "real", "b": "integer"}


class Column(NamedTuple):
    """A column and its values at all cells."""

    name: str
    role: str
    kind: str
    unit: str | None
    long_name: str | None
    values: Iterable[Any]


def plain(values: NDArray[Any]) -> Iterator[Any]:
    """Yield the values of an array (n,) as the database needs them; a list needs four times the memory."""
    for begin in range(0, len(values), MANY):
        yield from values[begin : begin + MANY].tolist()


def facts_of_points() -> list[PointColumn]:
    """Return the columns with facts about every point, in their order."""
    return [column for column in point_columns() if column.about.in_database]


def is_result(of: Statistic) -> bool:
    """Return whether a statistic is a result of a run, neither a fact about the run nor an assumption."""
    about = ("point_key", "effects", "by_request", *(c.name for c in facts_of_points()))
    return of.statistic != "value" or not (of.quantity in about or of.quantity.startswith(ASSUMED))


def write_wide_table(
    db: sqlite3.Connection, table: str, study: str, grid: Grid, statistics: list[Statistic], first: int | None
) -> None:
    """Make the table and insert all cells; cells that are points have the numbers from ``first`` on."""
    columns = [_number(first, grid.cells), *_axes(grid), *map(_column_of, statistics)]
    columns = [column for column in columns if column.name != "effects"]
    names = Names()
    columns = [column._replace(name=names.free(column.name)) for column in columns]
    declared = ", ".join(f"{quoted(c.name)} {c.kind}" for c in columns)
    db.execute(f"create table {quoted(table)} ({declared})")
    places = ", ".join("?" * len(columns))
    rows = zip(*(column.values for column in columns), strict=True)
    db.executemany(f"insert into {quoted(table)} values ({places})", rows)
    about = [(table, c.name, study, c.role, c.unit, c.long_name, k) for k, c in enumerate(columns)]
    db.executemany("insert into columns values (?, ?, ?, ?, ?, ?, ?)", about)


def _number(first: int | None, cells: int) -> Column:
    name, label = ("cell", "number of the cell") if first is None else ("point", "number of the point")
    numbers = range(first or 0, (first or 0) + cells)
    return Column(name, "row", "integer primary key", None, label, numbers)


def _axes(grid: Grid) -> Iterable[Column]:
    for number, axis in enumerate(grid.axes):
        kinds = {type(value) for value in axis.values}
        kind = "real" if float in kinds else "integer" if kinds == {int} else "text"
        yield Column(axis.name, "axis", kind, axis.unit, axis.long_name, grid.along(number))


def _column_of(of: Statistic) -> Column:
    name = of.quantity if of.statistic == "value" else f"{of.quantity}_{of.statistic}"
    label = of.long_name
    if of.statistic in ("amplitude", "last") and label:
        label = f"{label}, {of.statistic}"
    if name.startswith(ASSUMED) and of.long_name:
        return _assumed(name, of)
    role = "result" if is_result(of) else "row" if name == "point_key" else "fact"
    name = "key" if name == "point_key" else name
    values = plain(of.values)
    kind = TYPES.get(of.values.dtype.kind, "text")
    return Column(name, role, kind, of.unit, label, values)


def _assumed(name: str, of: Statistic) -> Column:
    """Return the column of an assumed input; in SI where all its values are quantities of one unit."""
    written = of.values.tolist()
    read = {text: in_si(of.long_name or "", text) for text in dict.fromkeys(written)}
    units = {unit for _, unit in read.values()}
    if len(units) == 1 and None not in units:
        numbers = [read[text][0] for text in written]
        return Column(name, "assumed", "real", units.pop(), of.long_name, numbers)
    return Column(name, "assumed", "text", None, of.long_name, [str(text) for text in written])
