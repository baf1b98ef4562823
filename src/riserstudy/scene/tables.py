"""Tables beside a scene: a CSV file of a current, motion or tensioner in place of points written out.

The first line names the columns with their units, as in ``elevation (m), speed (knot)``.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from riserstudy.errors import InputError
from riserstudy.scene.response import MOTIONS
from riserstudy.scene.text import read_text

MOST_ROWS = 100_000
MOST_BYTES = 10_000_000
_HEADING = re.compile(r"\s*(\w+)\s*\(([^)]+)\)\s*")

#: columns that a table may have besides, in any order
OPTIONAL = {
    "operators": ["heading", *(f"{name}{end}" for name in MOTIONS for end in ("", "_phase"))]
}

#: where a table may stand: path of its parent, name, columns, and where its rows go
PLACES = (
    (("current",), "profile", ("elevation", "speed"), None),
    *(
        (("platform",), motion, ("time", "value"), "points")
        for motion in ("surge", "sway", "heave", "roll", "pitch", "yaw")
    ),
    (("platform", "response"), "operators", ("period",), None),
    (("top", "tensioners"), "table", ("reach", "force"), None),
)


def fill_in_tables(tree: dict[str, Any], folder: Path) -> dict[str, Any]:
    """The tree with every ``{file: name.csv}`` replaced by its rows.

    Raises
    ------
    InputError
        With table, line and column of what cannot be read.
    """
    filled = dict(tree)
    for way, name, columns, key in PLACES:
        if way[0] not in filled:
            continue
        parent: Any = filled
        for step in way:
            parent = parent.get(step) if isinstance(parent, dict) else None
        here = parent.get(name) if isinstance(parent, dict) else None
        if not (isinstance(here, dict) and set(here) == {"file"}):
            continue
        rows = read_table(_place(folder, here["file"]), columns, OPTIONAL.get(name, []))
        filled = _with(filled, (*way, name), rows if key is None else {key: rows})
    return filled


def _with(tree: dict[str, Any], way: tuple[str, ...], value: Any) -> dict[str, Any]:
    """A copy of the tree with another value at the end of the way."""
    step, *further = way
    return {**tree, step: _with(tree[step], tuple(further), value) if further else value}


def _place(folder: Path, name: object) -> Path:
    """Where a table stands; only tables are read, so that no scene shows what else is on a machine."""
    if not isinstance(name, str) or not name.endswith(".csv"):
        allowed = "allowed is the path of a .csv file, seen from the scene"
        raise InputError(folder, "file", repr(name), allowed)
    return folder / name


def read_table(
    path: Path, columns: tuple[str, ...], optional: Sequence[str] = ()
) -> list[dict[str, str]]:
    """Rows of a CSV table, each value with the unit of its column."""
    text = read_text(path, MOST_BYTES)
    try:
        lines = list(csv.reader(io.StringIO(text, newline=""), strict=True))
    except csv.Error as error:
        raise InputError(path, "", f"no CSV: {error}", "allowed is a CSV file") from None
    wanted = ", ".join(f"{name} (unit)" for name in columns)
    headings = [_HEADING.fullmatch(cell) for cell in (lines[0] if lines else [])]
    found = [m.group(1) for m in headings if m]
    more = found[len(columns) :]
    fits = found[: len(columns)] == list(columns) and len(found) == len(headings)
    if not fits or len(set(more)) != len(more) or not set(more) <= set(optional):
        wanted += f", and any of {', '.join(optional)}" if optional else ""
        shown = ", ".join(lines[0]) if lines else "nothing"
        raise InputError(path, "line 1", repr(shown), f"allowed are the columns {wanted}")
    if len(lines) > MOST_ROWS:
        raise InputError(path, "", f"{len(lines)} lines", f"allowed are {MOST_ROWS}")
    units = [m.group(2).strip() for m in headings if m]
    rows = []
    for number, cells in enumerate(lines[1:], start=2):
        if not cells:
            continue
        if len(cells) != len(found):
            raise InputError(
                path, f"line {number}", f"{len(cells)} values", f"allowed are {len(found)}"
            )
        for cell in cells:
            try:
                float(cell)
            except ValueError:
                raise InputError(
                    path, f"line {number}", repr(cell), "allowed are numbers"
                ) from None
        rows.append(
            {c: f"{cell.strip()} {u}" for c, cell, u in zip(found, cells, units, strict=True)}
        )
    return rows
