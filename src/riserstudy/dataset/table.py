"""A table: a heading with units, and rows of plain values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

Cell = str | float | int | None


OF_ROW = "*"  # unit of a column whose unit differs by row, and is in the column `unit`


class Station(NamedTuple):
    """The station of a column, which its heading gives after the name of the output."""

    column: int
    output: str
    s: float  # m

    def heading(self, length: float = 1.0, unit: str = "m") -> str:
        """The heading, which `compare` can read. ``length``: factor from m to the unit (1)."""
        return f"{self.output} at {length * self.s:.8g} {unit}"


class Table(NamedTuple):
    """Columns, their units ("" for none, ``OF_ROW`` for the unit in the row's column ``unit``) and rows."""

    columns: list[str]
    units: list[str]
    rows: list[list[Cell]]
    stations: Sequence[Station] = ()


def aligned(rows: Sequence[Sequence[str]], right: Sequence[bool] = ()) -> list[str]:
    """Rows of cells as lines, in columns; those that are true in ``right`` are aligned to the right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    sides = right or [False] * len(widths)
    return [
        "  ".join(
            cell.rjust(width) if to_the_right else cell.ljust(width)
            for cell, width, to_the_right in zip(row, widths, sides, strict=True)
        ).rstrip()
        for row in rows
    ]


def heads(table: Table) -> list[str]:
    """Names of the columns, each with its unit."""
    return [
        f"{name} ({unit})" if unit not in ("", OF_ROW) else name
        for name, unit in zip(table.columns, table.units, strict=True)
    ]
