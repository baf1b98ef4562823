"""Tables of a scene: a CSV file of a current, motion, RAO, tensioner or soil, instead of points in the scene.

The first line names the columns with their units, as in ``elevation (m), speed (knot)``.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from pathlib import Path, PureWindowsPath
from typing import Any, NamedTuple

from riserstudy.errors import InputError
from riserstudy.inputs.number_cell import number_in
from riserstudy.inputs.strict import Strict
from riserstudy.inputs.text import read_text
from riserstudy.inputs.validate import check
from riserstudy.scene.forcing import Moved, Point, Tilted
from riserstudy.scene.rao import MOTIONS, SHIFTS, Operator
from riserstudy.scene.soil import ResistanceAt
from riserstudy.scene.tensioners import TableRow

MOST_ROWS = 100_000
MOST_BYTES = 10_000_000
_HEADING = re.compile(r"\s*(\w+)\s*\(([^)]+)\)\s*")


class Place(NamedTuple):
    """A place in a scene where a table may be given, and the columns of this table."""

    way: tuple[str, ...]  # path of the parent field
    name: str
    row: type[Strict]
    columns: tuple[tuple[str, ...], ...]  # required columns, each with its alternative names
    optional: tuple[str, ...] = ()  # further columns, in any order
    key: str = ""  # field below `name` that receives the rows; absent: `name` itself
    model: str = ""  # model that has the field; absent: the model that the parent is named after


PLACES = (
    Place(("current",), "profile", Point, (("elevation", "depth"), ("speed",)), ("direction",)),
    *(
        Place(
            ("platform",),
            motion,
            Moved if motion in SHIFTS else Tilted,
            (("time",), ("value",)),
            key="points",
        )
        for motion in MOTIONS
    ),
    Place(
        ("platform", "response"),
        "operators",
        Operator,
        (("period", "frequency"),),
        ("heading", *(f"{name}{end}" for name in MOTIONS for end in ("", "_phase"))),
    ),
    Place(("top", "tensioners"), "table", TableRow, (("reach",), ("force",))),
    Place(
        ("soil", "resistance"),
        "table",
        ResistanceAt,
        (("depth",), ("displacement",), ("resistance",)),
        model="TabulatedSoil",
    ),
)


def fill_in_tables(
    tree: dict[str, Any], folder: Path, held: Mapping[str, str] | None = None
) -> dict[str, Any]:
    """The tree in which checked rows replace every ``{file: name.csv}``.

    Raises InputError with table, line and column, if a value cannot be read or is not allowed.

    Parameters
    ----------
    tree : plain data of a scene, or of a part of it.
    folder : folder of the scene, to which paths of tables are relative.
    held : texts of the tables by name, if the scene comes from a dataset; no file is then read.
    """
    filled = dict(tree)
    for place in PLACES:
        if place.way[0] not in filled:
            continue
        parent: Any = filled
        for step in place.way:
            parent = parent.get(step) if isinstance(parent, dict) else None
        here = parent.get(place.name) if isinstance(parent, dict) else None
        if not (isinstance(here, dict) and set(here) == {"file"}):
            continue
        rows = _rows_of(here["file"], place, folder, held)
        filled = _with(filled, (*place.way, place.name), {place.key: rows} if place.key else rows)
    return filled


def files_of_tables(tree: dict[str, Any], folder: Path) -> Iterator[tuple[str, Path]]:
    """Tables of a scene: dotted path and file."""
    for place in PLACES:
        here: Any = tree
        for step in (*place.way, place.name):
            here = here.get(step) if isinstance(here, dict) else None
        if isinstance(here, dict) and isinstance(name := here.get("file"), str):
            yield ".".join((*place.way, place.name)), folder / name


def is_table(path: Path) -> bool:
    """Whether a file has the heading of a table that a scene can read."""
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            heading = next(csv.reader(file, strict=True), [])
    except (OSError, UnicodeDecodeError, csv.Error):
        return False
    columns = [m.group(1) for m in map(_HEADING.fullmatch, heading) if m]
    return any(not _wrong(heading, columns, place) for place in PLACES)


def names_of_tables(tree: Any) -> Iterator[str]:
    """Names of the tables that a tree, or a list of trees, refers to."""
    if isinstance(tree, dict):
        if isinstance(name := tree.get("file"), str):
            yield name
        tree = list(tree.values())
    if isinstance(tree, list | tuple):
        for part in tree:
            yield from names_of_tables(part)


def texts_of_tables(tree: Any, folder: Path, held: Mapping[str, str] | None = None) -> dict[str, str]:
    """Texts of the tables that a tree refers to, by name; ``held`` as in `fill_in_tables`.

    Raises InputError when a table cannot be read.
    """
    names = sorted({*names_of_tables(tree)})
    if held is not None:
        return {name: _held(name, held) for name in names}
    return {name: read_text(_file(folder, name), MOST_BYTES, named_in_scene=True) for name in names}


def _rows_of(name: object, place: Place, folder: Path, held: Mapping[str, str] | None) -> list[Strict]:
    """Rows of a table by its name in the scene."""
    if held is None:
        field = ".".join((*place.way, place.name, "file"))
        return read_table(_file(folder, name, field), place)
    return _rows(_lines(str(name), _held(name, held)), str(name), place)


def _held(name: object, held: Mapping[str, str]) -> str:
    """Text of a table that a dataset contains; a scene from a dataset reads no other table."""
    if not isinstance(name, str) or name not in held:
        allowed = "use a table that is stored in the dataset, or start from the scene file"
        raise InputError("dataset", "file", f"the dataset contains no table {name!r}", allowed)
    return held[name]


def _with(tree: dict[str, Any], way: tuple[str, ...], value: Any) -> dict[str, Any]:
    """A copy of the tree with another value at the path ``way``."""
    step, *further = way
    return {**tree, step: _with(tree[step], tuple(further), value) if further else value}


def _file(folder: Path, name: object, field: str = "file") -> Path:
    """File of a table. Only tables are read, so a foreign scene cannot reveal other files of a machine."""
    if not isinstance(name, str) or not name.endswith(".csv"):
        allowed = "give the path of a .csv file, relative to the folder of the scene"
        raise InputError(folder, field, f"{name!r} is not a CSV file", allowed)
    if "\\" in name or PureWindowsPath(name).drive:
        found = f"{name!r} is a path for Windows only"
        allowed = "write a path relative to the scene, with / between folders and without a drive letter"
        raise InputError(folder, field, found, allowed)
    return folder / name


def read_table(path: Path, place: Place) -> list[Strict]:
    """Checked rows of a CSV table; reread only if the file has changed, since many points share a table.

    Raises InputError when the table cannot be read, or a heading or line is not allowed.
    """
    try:
        stat = path.stat()
        stamp = stat.st_mtime_ns, stat.st_size
    except (OSError, ValueError):
        stamp = 0, 0  # reading the file then raises the error
    return _read(path, stamp, place)


@lru_cache(64)
def _read(path: Path, stamp: tuple[int, int], place: Place) -> list[Strict]:
    return _rows(_lines(path, read_text(path, MOST_BYTES, named_in_scene=True)), path, place)


def _rows(lines: list[list[str]], path: object, place: Place) -> list[Strict]:
    """Checked rows of the lines of a table; ``path`` names it in errors."""
    columns, units = _heading(path, lines[0] if lines else [], place)
    if len(lines) > MOST_ROWS:
        raise InputError(path, "", f"the table has {len(lines)} lines", f"give at most {MOST_ROWS} lines")
    rows = []
    for number, cells in enumerate(lines[1:], start=2):
        if not cells:
            continue
        if len(cells) != len(columns):
            found = f"the number of values, {len(cells)}, differs from the number of columns, {len(columns)}"
            raise InputError(path, f"line {number}", found, "write one value for each column")
        values = zip(columns, (_number(path, number, cell) for cell in cells), units, strict=True)
        row = {column: f"{value} {unit}" for column, value, unit in values}
        rows.append(check(place.row, row, f"{path}: line {number}"))
    return rows


def _lines(path: object, text: str) -> list[list[str]]:
    try:
        return list(csv.reader(io.StringIO(text, newline=""), strict=True))
    except csv.Error as error:
        raise InputError(path, "", f"this is not a valid CSV file: {error}", "save it as CSV") from None


def _heading(path: object, cells: Sequence[str], place: Place) -> tuple[list[str], list[str]]:
    """Names and units of the columns, which may be in any order."""
    named = [m for m in map(_HEADING.fullmatch, cells) if m]
    columns = [m.group(1) for m in named]
    wrong = _wrong(cells, columns, place)
    if wrong:
        wanted = ", ".join(" or ".join(f"{n} (unit)" for n in names) for names in place.columns)
        wanted += f", and any of {', '.join(place.optional)}" if place.optional else ""
        raise InputError(path, "line 1", wrong, f"write a heading with the columns {wanted}")
    return columns, [m.group(2).strip() for m in named]


def _wrong(cells: Sequence[str], columns: Sequence[str], place: Place) -> str:
    """The fault of a heading: an unknown or a missing column; "" if it has none."""
    if not cells:
        return "the table is empty"
    if len(columns) < len(cells):
        return (
            repr(next(c.strip() for c in cells if not _HEADING.fullmatch(c)))
            + " is not of the form 'name (unit)'"
        )
    known = {name for names in place.columns for name in names} | set(place.optional)
    if unknown := [name for name in columns if name not in known]:
        return f"unknown column {unknown[0]!r}"
    if twice := [name for name in columns if columns.count(name) > 1]:
        return f"column {twice[0]!r} occurs twice"
    for names in place.columns:
        there = [name for name in names if name in columns]
        if len(there) != 1:
            if there:
                return f"columns {' and '.join(map(repr, there))} exclude each other"
            return f"column {' or '.join(map(repr, names))} is missing"
    return ""


def _number(path: object, line: int, cell: str) -> str:
    if number_in(cell) is None:
        found = f"{cell!r} is not a number"
        raise InputError(path, f"line {line}", found, "write numbers only; units belong into line 1")
    return cell.strip()
