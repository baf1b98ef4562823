"""Workable hours by the direction that waves come from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from riserstudy.dataset.table import Cell, Table
from riserstudy.seas.directions import FROM

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.seas.hours import Hours

COLUMNS = ["waves from", "rows", "of all rows", "workable", "of the lost hours"]
UNITS = ["deg", "", "%", "%", "%"]
UNKNOWN = "no direction"


def by_direction(found: Hours, record: xr.Dataset, sectors: int) -> Table:
    """Workable and lost hours in equal sectors, the first about north, clockwise.

    A direction between two sectors belongs to the next one clockwise. Rows without a direction, such as calm
    rows, have their own row. ``record`` contains the rows of ``found``, and their directions in deg.
    """
    width = 360.0 / sectors
    row = np.searchsorted(record["time"].values, found.time)
    direction = record[FROM].values[row]
    sector = np.floor((direction + 0.5 * width) % 360.0 / width)
    names = [f"{(k - 0.5) * width % 360.0:g} to {(k + 0.5) * width % 360.0:g}" for k in range(sectors)]
    unknown = np.isnan(direction)
    places = [(name, sector == k) for k, name in enumerate(names)]
    places += [(UNKNOWN, unknown)] if unknown.any() else []
    lost = int((~found.workable).sum())
    rows: list[list[Cell]] = []
    for name, at in places:
        number = int(at.sum())
        workable = round(100.0 * float(found.workable[at].mean()), 1) if number else ""
        of_lost = round(100.0 * int((~found.workable[at]).sum()) / lost, 1) if lost else ""
        rows.append([name, number, round(100.0 * number / len(found.time), 1), workable, of_lost])
    return Table(COLUMNS, UNITS, rows)
