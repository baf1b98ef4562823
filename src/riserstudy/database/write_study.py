"""One dataset as rows: its study, and for a simulated study its points, parameters and results."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product, repeat
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.database.names import Names, quoted
from riserstudy.database.parameters import parameters_of
from riserstudy.database.read_dataset import Contents, Grid, read_dataset
from riserstudy.database.wide_table import facts_of_points, is_result, plain, write_wide_table
from riserstudy.database.write_parameters import Values, write_same, write_varied
from riserstudy.dataset.extremes import Statistic
from riserstudy.model.absent_effects import absent

MANY = 100_000  # most rows in memory at a time


@dataclass(frozen=True)
class About:
    """Contents of a study file about a dataset, and the path of the dataset in the results folder."""

    paper: str
    name: str
    kind: str
    caption: str
    path: str

    @property
    def study(self) -> str:
        """Paper and name, joined by a slash."""
        return f"{self.paper}/{self.name}"


def write_study(db: sqlite3.Connection, about: About, folder: Path, values: Values) -> None:
    """Read a dataset of a results folder and insert its contents."""
    contents = read_dataset(folder / about.path)
    (grid, statistics), *others = contents.grids
    tables = Names(name for (name,) in db.execute("select name from sqlite_master"))
    table = tables.free(f"{about.paper}_{about.name}")
    _write_head(db, about, table, contents)
    first = None
    if about.kind == "simulated":
        first = _write_points(db, about, contents)
        same, varied = parameters_of(contents.attributes, grid)
        write_same(db, values, about.study, same)
        write_varied(db, values, about.study, first, varied)
        _write_results(db, [t for t in statistics if is_result(t)], first)
    write_wide_table(db, table, about.study, grid, statistics, first)
    for other, further in others:
        over = "_".join(axis.name for axis in other.axes) or "all"
        name = tables.free(f"{table}_over_{over}")
        write_wide_table(db, name, about.study, other, further, None)


def marks(count: int) -> str:
    """Return placeholders for values in a statement."""
    return ", ".join("?" * count)


def _write_head(db: sqlite3.Connection, about: About, table: str, contents: Contents) -> None:
    attributes, grid = contents.attributes, contents.grids[0][0]
    scene, tuned = (json.loads(attributes.get(name, "{}")) for name in ("scene", "settings"))
    # points of a tuned study have its mesh and step, and the tolerance to which these were tuned
    accuracy = scene.get("analysis", {}).get("accuracy") or tuned.get("accuracy")
    row = (
        *(about.study, about.paper, about.name, about.kind, about.caption),
        *(json.dumps({a.name: len(a.values) for a in grid.axes}), grid.cells),
        *(attributes.get("scene_file"), attributes.get("tier"), accuracy),
        *(attributes.get("engine"), table, about.path),
    )
    db.execute(f"insert into studies values ({marks(len(row))})", row)


def _write_points(db: sqlite3.Connection, about: About, contents: Contents) -> int:
    """Insert the points of a study; return the number of the first point."""
    grid, _ = contents.grids[0]
    of = {v.name: v.values for v in grid.variables if not v.within}
    first: int = db.execute("select coalesce(max(point), 0) + 1 from points").fetchone()[0]
    # datasets of earlier versions lack some facts
    facts = {f.name: repeat("" if f.about.kind == "text" else None) for f in facts_of_points()}
    rows = zip(
        range(first, first + grid.cells),
        repeat(about.study),
        range(grid.cells),
        plain(of["point_key"]),
        _places(grid),
        repeat(contents.attributes["engine"]),
        _effect_sets(db, contents.attributes, of.get("effects")),
        *(plain(of[name]) if name in of else absent_fact for name, absent_fact in facts.items()),
        strict=False,  # the repeated item has no end
    )
    db.executemany(f"insert into points values ({marks(7 + len(facts))})", rows)
    return first


def _places(grid: Grid) -> Iterator[str]:
    """Yield the positions of points on the axes, as text."""
    texts = [[f"{a.name}={value}" for value in a.values] for a in grid.axes]
    return map(", ".join, product(*texts))


def _effect_sets(
    db: sqlite3.Connection, attributes: dict[str, Any], effects: NDArray[Any] | None
) -> Iterator[int | None]:
    """Return the numbers of the points' sets of effects; None where the dataset does not contain them."""
    if effects is None:
        return repeat(None)
    why = json.loads(attributes["effects"])
    number: int = db.execute("select coalesce(max(effect_set), 0) from effect_sets").fetchone()[0]
    numbers: dict[str, int | None] = {}
    for text in dict.fromkeys(effects):
        number += 1
        numbers[text] = number
        on = text.splitlines()
        rows = [(number, name, 1, why.get(name, "")) for name in on]
        rows += [(number, name, 0, reason) for name, reason in absent(set(on)).items()]
        db.executemany("insert into effect_sets values (?, ?, ?, ?)", rows)
    return map(numbers.__getitem__, plain(effects))


def _write_results(db: sqlite3.Connection, statistics: list[Statistic], first: int) -> None:
    """Insert the statistics of all points, point by point."""
    numeric = [(t, _quantity_id(db, t)) for t in statistics if t.values.dtype.kind in "fiu"]
    if not numeric:
        return
    numeric.sort(key=lambda pair: pair[1])
    ids = np.array([number for _, number in numeric])
    cells = len(numeric[0][0].values)
    nothing = np.full(cells, np.nan)
    for begin in range(0, cells, some := max(1, MANY // len(ids))):
        part = slice(begin, min(begin + some, cells))
        values = np.stack([t.values[part].astype(float) for t, _ in numeric], axis=1).ravel()
        there = ~np.isnan(values)
        points = np.repeat(np.arange(first + part.start, first + part.stop), len(ids))
        columns = [points[there].tolist(), np.tile(ids, part.stop - part.start)[there].tolist()]
        columns.append(values[there].tolist())
        for name in ("s", "time", "cylinder"):
            at = [t.at.get(name, nothing)[part] for t, _ in numeric]
            columns.append(np.stack(at, axis=1).ravel()[there].tolist())
        db.executemany("insert into result_values values (?, ?, ?, ?, ?, ?)", zip(*columns, strict=True))


def _quantity_id(db: sqlite3.Connection, of: Statistic) -> int:
    about = (of.quantity, of.statistic, of.unit, of.long_name)
    requested = "select quantity_id from quantities where quantity = ? and statistic = ? and unit is ?"
    row = db.execute(requested, about[:3]).fetchone()
    if row is None:
        statement = "insert into quantities values (null, ?, ?, ?, ?) returning quantity_id"
        row = db.execute(statement, about).fetchone()
    number: int = row[0]
    return number


def remove_study(db: sqlite3.Connection, study: str) -> None:
    """Delete a study with all rows that belong only to it."""
    statement = "select distinct table_name from columns where study = ?"
    for (table,) in db.execute(statement, (study,)).fetchall():
        db.execute(f"drop table {quoted(table)}")
    db.execute("delete from studies where study = ?", (study,))


def remove_unused(db: sqlite3.Connection) -> None:
    """Delete rows to which no row refers any longer."""
    for table, key, *users in (
        ("parameter_sets", "parameter_set", "point_sets"),
        ("parameter_values", "value_id", "study_parameters", "parameter_sets"),
        ("paths", "path_id", "parameter_values"),
        ("effect_sets", "effect_set", "points"),
        ("quantities", "quantity_id", "result_values"),
    ):
        used = "".join(f" except select {key} from {user}" for user in users)
        db.execute(f"delete from {table} where {key} in (select {key} from {table}{used})")
