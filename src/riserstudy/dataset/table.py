"""A table: a heading with units, and rows of plain values."""

from __future__ import annotations

from typing import NamedTuple

Cell = str | float | int | None


OF_ROW = "*"  # unit of a column whose unit differs by row, and is in the column `unit`


class Table(NamedTuple):
    """Columns, their units ("" for none, ``OF_ROW`` for the unit in the row's column ``unit``) and rows."""

    columns: list[str]
    units: list[str]
    rows: list[list[Cell]]


def heads(table: Table) -> list[str]:
    """Names of the columns, each with its unit."""
    return [
        f"{name} ({unit})" if unit not in ("", OF_ROW) else name
        for name, unit in zip(table.columns, table.units, strict=True)
    ]
