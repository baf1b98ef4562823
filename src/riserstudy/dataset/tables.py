"""Tables of a run: stack-up, extremes, time series, limits; each a heading and rows of plain values."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from riserstudy.csv_files import write_csv as write_whole
from riserstudy.dataset.variables import attributes
from riserstudy.errors import InputError
from riserstudy.scene.ends import Body
from riserstudy.scene.limits import UNITS
from riserstudy.scene.models import Scene
from riserstudy.scene.riser import Section

if TYPE_CHECKING:
    import xarray as xr

Cell = str | float | int | None


class Table(NamedTuple):
    """Columns, their units ("" for none) and rows."""

    columns: list[str]
    units: list[str]
    rows: list[list[Cell]]


def stack_up(scene: Scene) -> Table:
    """The riser from the top down: joints, diameters, weights dry and in water, uplift, sums from the top.

    Dry and wet weight of a section are those of its pipe, modules and lines together; its uplift is what its
    dry weight loses in water, contents apart. Modules and lines stand beside, dry, and the lift of modules
    beyond their own weight. A telescopic joint above the ring hangs on the deck and is left out.
    """
    columns = {
        "section": "", "joints": "", "length": "m", "upper end": "m", "outer diameter": "m",
        "inner diameter": "m", "mass": "kg/m", "dry weight": "kN", "wet weight": "kN", "uplift": "kN",
        "lines, dry": "kN", "modules, dry": "kN", "lift of modules": "kN",
        "contents": "kN", "wet weight from the top": "kN", "with contents from the top": "kN",
    }  # fmt: skip
    gravity = scene.gravity
    sums = [0.0, 0.0]
    upper = _upper_end(scene)
    rows: list[list[Cell]] = []

    def add(
        about: list[Cell],
        dry: float | None,
        wet: float | None,
        inside: float,
        parts: list[Cell],
    ) -> None:
        sums[0] += wet or 0.0
        sums[1] += (wet or 0.0) + inside
        uplift = None if dry is None or wet is None else dry - wet
        rows.append([*about, dry, wet, uplift, *parts, inside, *sums])

    def add_body(body: Body | None, at: float | None) -> None:
        if body:
            dry = body.mass * gravity / 1e3 if gravity else None
            water = scene.water.density if scene.water else 0.0
            wet = None if body.weightless else body.weight(gravity or 0.0, water) / 1e3
            add([body.name, None, None, at, None, None, None], dry, wet, 0.0, [None] * 3)

    add_body(scene.top.body, upper)
    for section in reversed(scene.sections):
        length, each = section.total_length, section.submerged_weight
        joints = section.joints.count if section.joints else None
        diameters = [section.outer_diameter, section.inner_diameter]
        dry = section.mass * gravity * length / 1e3 if section.mass and gravity else None
        wet = None if each is None else each * length / 1e3
        inside = section.contents_mass * (gravity or 0.0) * length / 1e3
        about = [section.name, joints, length, upper, *diameters, section.mass]
        add(about, dry, wet, inside, _parts(section, gravity))
        upper = None if upper is None else upper - length
    add_body(scene.bottom.body, upper)
    return Table(list(columns), list(columns.values()), rows)


def _parts(section: Section, gravity: float | None) -> list[Cell]:
    """Dry weight of lines and of modules, and what modules lift beyond theirs (kN); None without."""
    total = (gravity or 0.0) * section.total_length / 1e3
    lines = total * sum(x.all_mass for x in section.lines) if section.lines else None
    count = section.joints.count if section.joints else 1
    modules = (gravity or 0.0) * count * section.modules.mass / 1e3 if section.modules else None
    lift = section.buoyancy_lift
    return [lines, modules, None if lift is None else lift * section.total_length / 1e3]


def _upper_end(scene: Scene) -> float | None:
    """Elevation of the riser's upper end before it stretches (m)."""
    if scene.bottom.elevation is not None:
        return scene.bottom.elevation + sum(s.total_length for s in scene.sections)
    return scene.top.elevation


def extremes(dataset: xr.Dataset) -> Table:
    """Largest and smallest value of every output and place, with arclength and time, in SI units."""
    keys = [
        "largest",
        "largest_s",
        "largest_time",
        "smallest",
        "smallest_s",
        "smallest_time",
        "mean",
    ]
    rows: list[list[Cell]] = []
    for row in json.loads(dataset.attrs.get("extremes", "[]")):
        unit = attributes(row["output"])["units"]
        rows.append([row["output"], row["where"], unit, *(row.get(key) for key in keys)])
    units = ["", "", "", "", "m", "s", "", "m", "s", ""]
    return Table(["output", "where", "unit", *keys], units, rows)


def time_series(dataset: xr.Dataset) -> Table:
    """All histories, a column each: those along the riser at their stations.

    Raises
    ------
    InputError
        When the run has no time.
    """
    if "time" not in dataset:
        raise InputError("dataset", "time", "a run at rest", "time series need analysis.duration")
    columns, units, values = ["time"], ["s"], [dataset["time"].values]
    for name, history in dataset.data_vars.items():
        if "time" not in history.dims:
            continue
        unit = str(history.attrs.get("units", ""))
        across = [dim for dim in history.dims if dim != "time"]
        for k in range(history.sizes[across[0]] if across else 1):
            at = history.isel({across[0]: k}) if across else history
            place = f" at {across[0]} = {float(dataset[across[0]][k]):g}" if across else ""
            columns.append(f"{name}{place}")
            units.append(unit)
            values.append(at.values)
    rows: list[list[Cell]] = [[float(v) for v in row] for row in zip(*values, strict=True)]
    return Table(columns, units, rows)


def limits(dataset: xr.Dataset) -> Table:
    """Demand, allowable and use of every limit of the scene, with place, time and verdict, in SI units."""
    rows = json.loads(dataset.attrs.get("limits", "[]"))
    names = ["output", "at", "mode", "side", "unit", "demand", "allowable", "utilisation"]
    names += ["s", "time", "verdict", "missing", "origin", "takes"]
    units = ["m" if name == "s" else "s" if name == "time" else "" for name in names]
    return Table(names, units, [[row.get(name, "") for name in names] for row in rows])


#: how a limit is printed: factor and name of the unit
READ_IN = {
    "N": (1e-3, "kN"), "N*m": (1e-3, "kN m"), "N/m^2": (1e-6, "MPa"),
    "rad": (57.29577951308232, "deg"), "m": (1.0, "m"),
}  # fmt: skip


def as_lines(rows: list[dict[str, Any]]) -> list[str]:
    """Limits as one readable line each: demand, allowable, use, where and when, or what is missing."""
    lines = []
    for row in rows:
        factor, unit = READ_IN[UNITS[row["output"]]]
        place = f" at {row['at']}" if row["at"] else ""
        takes = f" ({row['takes']})" if row.get("takes") else ""
        what = f"{row['mode']}: {row['side']} {row['output']}{place}{takes}"
        allowed = f"allowable {factor * row['allowable']:.5g} {unit} ({row['origin']})"
        if row["demand"] is None:
            lines.append(f"{what}: not evaluated: {row['missing']}; {allowed}")
            continue
        where = "" if row["s"] is None else f" at s = {row['s']:.5g} m"
        when = "" if row["time"] is None else f" at t = {row['time']:.5g} s"
        use = f"{100 * row['utilisation']:.4g} %" if row["utilisation"] < 1e3 else "beyond all"
        text = f"{factor * row['demand']:.5g} {unit}{where}{when}, {allowed}, use {use}"
        verdict = row["verdict"] + (
            f"; not known everywhere for want of {row['missing']}" if row["missing"] else ""
        )
        lines.append(f"{what}: {text}: {verdict}")
    return lines


def write_csv(table: Table, target: Path) -> None:
    """Write a table as CSV: a line of names with their units, then the rows.

    Raises
    ------
    SimulationError
        When it cannot be written, as on a full disk.
    """
    heads = [f"{n} ({u})" if u else n for n, u in zip(table.columns, table.units, strict=True)]
    write_whole(target, heads, ([_text(cell) for cell in row] for row in table.rows))


def _text(cell: Cell) -> Cell:
    """To ten digits, as datasets are stored."""
    return f"{cell:.10g}" if isinstance(cell, float) else cell


def table_of(kind: str, scene: Scene | None, dataset: xr.Dataset | None) -> Table:
    """A table by its name: stack-up is that of the scene, the others of its run.

    Raises
    ------
    InputError
        When what the table is made of is not there.
    """
    if kind == "stack-up" and scene is not None:
        return stack_up(scene)
    made = {"extremes": extremes, "time-series": time_series, "limits": limits}.get(kind)
    if made is None or dataset is None:
        raise InputError("table", kind, "nothing to make it from", "allowed is a scene or its run")
    return made(dataset)
