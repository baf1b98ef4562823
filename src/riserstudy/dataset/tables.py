"""Tables of a run: stack-up, extremes, time series, limits; each has a heading and rows of plain values."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from riserstudy.dataset.recoil_table import recoil
from riserstudy.dataset.stack_up import stack_up
from riserstudy.dataset.table import OF_ROW, Cell, Station, Table, aligned, heads
from riserstudy.dataset.unit_systems import UnitSystem, read_in
from riserstudy.dataset.variables import attributes
from riserstudy.errors import InputError
from riserstudy.files.csv_files import write_csv as write_whole
from riserstudy.scene.resolve import Resolved

if TYPE_CHECKING:
    import xarray as xr


def extremes(dataset: xr.Dataset) -> Table:
    """Largest and smallest value of every output and place, with arclength and time, in SI units."""
    keys = ["largest", "largest_s", "largest_time", "smallest", "smallest_s", "smallest_time", "mean"]
    rows: list[list[Cell]] = []
    for row in json.loads(dataset.attrs.get("extremes", "[]")):
        unit = attributes(row["output"])["units"]
        rows.append([row["output"], row["where"], unit, *(row.get(key) for key in keys)])
    units = ["", "", "", OF_ROW, "m", "s", OF_ROW, "m", "s", OF_ROW]
    return Table(["output", "where", "unit", *keys], units, rows)


def time_series(dataset: xr.Dataset) -> Table:
    """All histories, one column each; histories along the riser at their stations.

    Raises InputError when the run is static.
    """
    if "time" not in dataset:
        found = "the run is static and has no time histories"
        raise InputError("dataset", "time", found, "add analysis.duration and output to its scene")
    columns, units, values = ["time"], ["s"], [dataset["time"].values]
    stations = []
    for name, history in dataset.data_vars.items():
        if "time" not in history.dims:
            continue
        unit = str(history.attrs.get("units", ""))
        across = [dim for dim in history.dims if dim != "time"]
        for k in range(history.sizes[across[0]] if across else 1):
            at = history.isel({across[0]: k}) if across else history
            heading = str(name)
            if across and across[0] == "s":
                stations.append(Station(len(columns), heading, float(dataset["s"][k])))
                heading = stations[-1].heading()
            elif across:
                heading = f"{name} at {across[0]} {dataset[across[0]][k].item():g}"
            columns.append(heading)
            units.append(unit)
            values.append(at.values)
    rows: list[list[Cell]] = [[float(v) for v in row] for row in zip(*values, strict=True)]
    return Table(columns, units, rows, stations)


def limits(dataset: xr.Dataset) -> Table:
    """Demand, allowable and utilisation of every limit, with place, time and verdict, in SI units."""
    rows = json.loads(dataset.attrs.get("limits", "[]"))
    names = ["output", "at", "mode", "side", "unit", "demand", "allowable", "utilisation"]
    names += ["s", "time", "verdict", "missing", "origin", "takes"]
    known = {"s": "m", "time": "s", "demand": OF_ROW, "allowable": OF_ROW}
    units = [known.get(name, "") for name in names]
    return Table(names, units, [[row.get(name, "") for name in names] for row in rows])


def in_units(table: Table, system: UnitSystem) -> Table:
    """A table with values in a system of units, which its headings and its column ``unit`` state.

    Places in headings are converted, too.
    """
    length = read_in("m", system)
    columns = [*table.columns]
    for station in table.stations:
        columns[station.column] = station.heading(length.factor, length.unit)
    whole = [read_in(unit, system) for unit in table.units]
    own = table.columns.index("unit") if "unit" in table.columns else None

    def converted(row: list[Cell]) -> list[Cell]:
        of_row = read_in(str(row[own]), system) if own is not None else None
        cells: list[Cell] = []
        for k, cell in enumerate(row):
            reading = of_row if table.units[k] == OF_ROW else whole[k]
            if k == own and of_row:
                cells.append(of_row.unit)
            elif reading is None or not isinstance(cell, float):
                cells.append(cell)
            else:
                cells.append(reading.factor * cell)
        return cells

    units = [unit if unit == OF_ROW else one.unit for unit, one in zip(table.units, whole, strict=True)]
    return Table(columns, units, [converted(row) for row in table.rows], table.stations)


def in_columns(table: Table) -> list[str]:
    """A table as aligned lines: names with units, then the rows with numbers to five digits.

    A missing value is printed as an empty cell.
    """
    texts = [[_cell_text(cell) for cell in row] for row in table.rows]
    numeric = [not any(isinstance(c, str) for c in column) for column in zip(*table.rows, strict=True)]
    return aligned([heads(table), *texts], numeric)


def write_csv(table: Table, target: Path) -> None:
    """Write a table as CSV: a line of names with their units, then the rows.

    Raises SimulationError when it cannot be written, as on a full disk.
    """
    write_whole(target, heads(table), ([_text(cell) for cell in row] for row in table.rows))


def _cell_text(cell: Cell) -> str:
    """Text of a cell; "" for a missing value."""
    if cell is None or cell != cell:  # NaN
        return ""
    return f"{cell:.5g}" if isinstance(cell, float) else str(cell)


def _text(cell: Cell) -> Cell:
    """A cell with ten digits, as in datasets."""
    return f"{cell:.10g}" if isinstance(cell, float) else cell


def table_of(kind: str, scene: Resolved | None, dataset: xr.Dataset | None) -> Table:
    """A table by its name: stack-up needs the scene, recoil scene and run, the others the run.

    Raises InputError when the scene or the run is missing.
    """
    if kind == "stack-up" and scene is not None:
        return stack_up(scene)
    if kind == "recoil" and scene is not None and dataset is not None:
        return recoil(scene, dataset)
    made = {"extremes": extremes, "time-series": time_series, "limits": limits}.get(kind)
    if made is None or dataset is None:
        found = "this table requires a scene or the dataset of a run"
        raise InputError("table", kind, found, "give one of them")
    return made(dataset)


def tables_of(scene: Resolved | None, dataset: xr.Dataset) -> dict[str, Table]:
    """All tables of a run, by name; a static run has no time series."""
    names = ["extremes", *(["time-series"] if "time" in dataset else [])]
    names += ["limits"] if json.loads(dataset.attrs.get("limits", "[]")) else []
    made = {name: table_of(name, scene, dataset) for name in names}
    return ({"stack-up": stack_up(scene)} if scene else {}) | made
