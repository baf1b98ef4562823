"""Tables of text: cells separated by comma, semicolon or tab, with headings above numbers.

Tables of programs and spreadsheets may have titles above the headings, units on a separate line, commas as
decimal marks, and empty cells. The notes state all decisions and omissions.
"""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from riserstudy.errors import InputError
from riserstudy.inputs.number_cell import number_in
from riserstudy.inputs.text import read_text
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.units import MOST

MOST_BYTES = 100_000_000
MISSING = ("", "-", "~", "n/a", "nan")  # cells without a number
MARKS = (("tab", "\t"), ("semicolon", ";"), ("comma", ","))
_UNIT = re.compile(r"\([^()]*\)|\[[^][]*\]|")


class Text(NamedTuple):
    """A table of text."""

    above: list[str]  # lines above the headings
    headings: list[str]  # (k,)
    columns: list[FloatArray]  # k arrays (n,), NaN for an empty cell
    notes: list[str]  # notes on how it was read


def read_table(path: Path) -> Text:
    """Read a table. Raises InputError when the file is not a table of numbers below headings."""
    lines = read_text(path, MOST_BYTES).splitlines()
    name, mark = _mark(lines)
    rows = [(k, [cell.strip() for cell in row]) for k, row in _rows(path, lines, mark) if any(row)]
    decimal = _decimal_comma(path, mark, rows)
    first = next((n for n, (_, row) in enumerate(rows) if _is_numbers(row, decimal)), None)
    if not first:  # 0: a table without headings
        found = "the file has no numbers below a line of headings"
        raise InputError(path, "", found, "write a heading above each column")
    titles, used = _headings(rows, first)
    width = max((k + 1 for k, cell in enumerate(titles) if cell), default=0)
    if width < 2:
        found = f"the file has only one column, if cells are separated by the {name}"
        raise InputError(path, "", found, "give two columns or more, each with a heading")
    columns = _numbers(path, rows[first:], titles[:width], decimal)
    above = [" ".join(cell for cell in row if cell) for _, row in rows[: first - used]]
    notes = [f"left out: {len(above)} of the lines, above the headings"] if above else []
    if decimal:
        notes.append(f"commas are decimal marks, and cells are separated by the {name}")
    return Text(above, titles[:width], columns, notes)


def _mark(lines: list[str]) -> tuple[str, str]:
    """Name and sign of the separator: the first of tab, semicolon and comma that is in half of the lines."""
    full = [line for line in lines[:1000] if line.strip()]
    for name, mark in MARKS:
        if full and sum(mark in line for line in full) > 0.5 * len(full):
            return name, mark
    return MARKS[-1]


def _rows(path: Path, lines: list[str], mark: str) -> list[tuple[int, list[str]]]:
    reader = csv.reader(lines, delimiter=mark)
    try:
        return [(reader.line_num, row) for row in reader]
    except csv.Error as error:
        found = f"{error}"
        raise InputError(
            path, f"line {reader.line_num}", found, "correct this line of the CSV file"
        ) from None


def _decimal_comma(path: Path, mark: str, rows: list[tuple[int, list[str]]]) -> bool:
    """Whether commas are decimal marks: cells have another separator, and no cell has a point."""
    if mark == ",":
        return False
    point = comma = 0
    for line, row in rows:
        for cell in row:
            if "," in cell and number_in(cell.replace(",", ".", 1)) is not None:
                comma = comma or line
            elif "." in cell and number_in(cell) is not None:
                point = point or line
        if point and comma:
            found = f"has a decimal comma, and line {point} a decimal point"
            raise InputError(path, f"line {comma}", found, "use one decimal mark in the whole file")
    return bool(comma)


def _value(cell: str, decimal: bool) -> float | None:
    """Number in a cell; NaN for an empty cell, None for text."""
    if cell.lower() in MISSING:
        return math.nan
    text = cell.replace(",", ".", 1) if decimal else cell
    return number_in(text)


def _is_numbers(row: list[str], decimal: bool) -> bool:
    """Whether a row has numbers: its first cell is a number, and no cell is text."""
    first = _value(row[0], decimal) if row else None
    known = first is not None and math.isfinite(first)
    return known and all(_value(cell, decimal) is not None for cell in row)


def _headings(rows: list[tuple[int, list[str]]], first: int) -> tuple[list[str], int]:
    """Headings, with units from a separate line, and the number of their lines."""
    titles = rows[first - 1][1]
    if first < 2 or not any(titles) or not all(_UNIT.fullmatch(cell) for cell in titles):
        return titles, 1
    names = rows[first - 2][1]
    names = names + [""] * (len(titles) - len(names))
    return [f"{n} {u}".strip() for n, u in zip(names, titles, strict=False)], 2


def _numbers(
    path: Path, rows: list[tuple[int, list[str]]], titles: list[str], decimal: bool
) -> list[FloatArray]:
    """Numbers below the headings; empty cells beyond the last heading are ignored."""
    width, numbers = len(titles), list[float]()
    for line, row in rows:
        if len(row) < width or any(row[width:]):
            cells = max((k + 1 for k, cell in enumerate(row) if cell), default=0)
            allowed = "write a cell for each heading"
            found = f"the number of cells, {cells}, differs from the number of headings, {width}"
            raise InputError(path, f"line {line}", found, allowed)
        for cell, title in zip(row, titles, strict=False):
            value = _value(cell, decimal)
            if value is None or abs(value) > MOST:
                found = f"{cell!r} in column {title!r} is not a number up to {MOST:g}"
                raise InputError(path, f"line {line}", found, "write a number, or leave the cell empty")
            numbers.append(value)
    columns = np.array(numbers, np.float64).reshape(-1, width).T
    for title, column in zip(titles, columns, strict=True):
        if not title:
            raise InputError(path, "", "a column has no heading", "write a heading above each column")
        if not np.isfinite(column).any():
            raise InputError(path, title, "this column has no numbers", "remove the column")
    return [*columns]
