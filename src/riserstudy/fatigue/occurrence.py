"""Occurrence of sea states, from a scatter table or the hours of a record, in the axes of a study."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.unit_names import factor_between, scene_notation
from riserstudy.errors import InputError
from riserstudy.inputs.number_cell import number_in
from riserstudy.inputs.text import read_text
from riserstudy.records.arrays import FloatArray
from riserstudy.records.words import counted
from riserstudy.scene.units import UnitFault, unit_factor
from riserstudy.study.months import uneven_months
from riserstudy.study.spacing import check_spacing

if TYPE_CHECKING:
    import xarray as xr

LARGEST_TABLE = 10**7  # largest size of a table, in bytes
HOURS = 8766.0  # hours in a year of 365.25 days
PEAK = "peak_period"
FROM = "wave_from_direction"
WHOLE = 0.005  # largest excess of the sum of shares above one, due to rounding
WEIGHTS = {"share": "%", "time": "h", "count": ""}  # columns with the occurrence, and their units
OF_CALM = ("m", "s", "m/s")  # SI units of the axes to which `calm` applies
TURNS = {"degree": 360.0, "rad": 2.0 * math.pi}  # a whole turn, by units of angles
_HEAD = re.compile(r"\s*(?P<name>[^(\[]+?)\s*(?:[(\[](?P<unit>[^)\]]*)[)\]])?\s*")
#: names that a column of a table or of a record may have for an axis, in lower case
ALSO = (
    ("hs", "h_s", "hm0", "swh", "significant_height", "significant_wave_height", "wave_height"),
    ("tp", "t_p", "peak_period", "wave_period"),
    ("current", "current_speed", "surface_current_speed"),
)
#: of these, names that are only for irregular seas
OF_SEAS = ("hs", "h_s", "hm0", "swh", "significant_height", "significant_wave_height",
           "tp", "t_p", "peak_period")  # fmt: skip

#: ambiguous names, of which the height or period is not clear, nor whether it is that of a regular wave
UNSURE = {
    "wave_height": "significant_height, unless it is the largest wave height, which is twice as large",
    "wave_period": "peak_period, if the periods are peak periods",
}


class Occurrence(NamedTuple):
    """Sea states and their occurrence: values by axis, (n,) each, and shares of all time, (n,)."""

    values: dict[str, FloatArray]
    shares: FloatArray
    notes: tuple[str, ...]  # notes on omitted or summed rows, a line each
    irregular: tuple[str, ...] = ()  # axes with values of irregular seas: H_s, T_p


def of_table(path: Path, study: xr.Dataset, axes: list[str]) -> Occurrence:
    """Sea states of a scatter table in long form, with one row for each sea state.

    Its header names axes of the study with their units, and one of ``share (%)``, ``time (h)``, which is
    hours per year, and ``count``: ``hs (m),tp (s),share (%)``. Raises InputError with row and column: a
    missing unit or number, no column or several columns of occurrence, or shares above 100 %.
    """
    rows = list(csv.reader(io.StringIO(read_text(path, LARGEST_TABLE), newline=None)))
    rows = [row for row in rows if any(cell.strip() for cell in row)]
    if len(rows) < 2:
        found = "the table has no rows below its header"
        raise InputError(path, "", found, "write a header and a row for each sea state")
    weight, factors, irregular = _heads(path, rows[0], study, axes)
    columns: dict[str, list[float]] = {axis: [] for axis, _ in factors.values()}
    often = []
    for number, row in enumerate(rows[1:], start=2):
        if len(row) != len(rows[0]):
            found = f"the row has {len(row)} cells, but the header {len(rows[0])}"
            raise InputError(f"{path}, row {number}", "", found, "write one cell for each column")
        for k, (axis, factor) in factors.items():
            columns[axis].append(factor * _number(path, number, rows[0][k], row[k]))
        often.append(_number(path, number, rows[0][weight], row[weight]))
        if often[-1] < 0.0:
            found = f"{row[weight]} is negative"
            raise InputError(f"{path}, row {number}", rows[0][weight], found, "give 0 or more")
    name = _head(path, rows[0][weight])[0]
    shares = np.array(often) / {"share": 100.0, "time": HOURS, "count": sum(often) or 1.0}[name]
    notes, some = _summed(path, shares), shares > 0.0
    values = {axis: np.array(column)[some] for axis, column in columns.items()}
    return Occurrence(values, shares[some], notes, tuple(irregular))


def _heads(
    path: Path, heads: list[str], study: xr.Dataset, axes: list[str]
) -> tuple[int, dict[int, tuple[str, float]], list[str]]:
    """Column of the occurrence, axes with their units by column, and axes of irregular seas.

    Raises InputError with the heading, if it has no unit, is no axis of the study, is ambiguous, or occurs
    twice.
    """
    weight, irregular = None, list[str]()
    factors: dict[int, tuple[str, float]] = {}
    for k, text in enumerate(heads):
        name, unit = _head(path, text)
        if name in WEIGHTS:
            if weight is not None:
                found = "two columns state how often sea states occur"
                raise InputError(path, name, found, "remove one of them")
            if unit != WEIGHTS[name]:
                unit_of = f"({WEIGHTS[name]})" if WEIGHTS[name] else "without a unit"
                allowed = f"write {name} {unit_of}"
                raise InputError(path, name, f"the unit {unit!r} is wrong", allowed)
            weight = k
        elif (axis := axis_of(name, axes)) is None:
            allowed = f"use {', '.join([*axes, *WEIGHTS])}"
            raise InputError(path, text.strip(), "this is not an axis of the study", allowed)
        else:
            if name in UNSURE and name != axis:
                found = "this heading is ambiguous"
                raise InputError(path, text.strip(), found, f"write {UNSURE[name]}")
            if axis in (known for known, _ in factors.values()):
                raise InputError(path, text.strip(), f"two columns give {axis}", "remove one of them")
            irregular += [axis] if name in OF_SEAS else []
            factors[k] = axis, _factor(path, text, unit, study[axis].attrs.get("units", ""))
    if weight is None:
        allowed = "add a column share (%), time (h) or count"
        raise InputError(path, "", "the table does not state how often sea states occur", allowed)
    return weight, factors, irregular


def of_record(record: xr.Dataset, study: xr.Dataset, axes: list[str]) -> Occurrence:
    """Sea states of a record, hour by hour, each with its share of all hours that have every quantity.

    Raises InputError when no quantity of the record is an axis of the study, a unit does not fit, no row has
    every quantity, rows have another interval in a part of the record, or an axis has the name of the
    record's bearings, which are not headings of a scene.
    """
    columns, irregular = {}, []
    for name in map(str, record.data_vars):
        if axis := axis_of(name, axes):
            if name == FROM:
                found = "the record has compass bearings, but the study has angles from the x axis"
                allowed = "give a scatter table with the headings of the study"
                raise InputError("--seas", name, found, allowed)
            unit = scene_notation(str(record[name].attrs.get("units", "")))
            factor = _factor("--seas", name, unit, study[axis].attrs.get("units", ""))
            columns[axis] = factor * record[name].values
            irregular += [axis] if name.lower() in OF_SEAS else []
    if not columns:
        allowed = f"give a study with an axis such as significant_height (its axes: {', '.join(axes)})"
        raise InputError("--seas", "", "no quantity of the record is an axis of the study", allowed)
    table = np.stack(list(columns.values()), axis=1)
    whole = np.asarray(np.isfinite(table).all(axis=1))
    if not whole.any():
        found = f"no row of the record has {' and '.join(columns)}"
        raise InputError("--seas", "", found, "give a record with these values")
    if np.issubdtype(record["time"].dtype, np.datetime64):
        check_spacing("--seas", record["time"].values[whole])
    found_states, counts = np.unique(table[whole], axis=0, return_counts=True)
    values = {axis: found_states[:, k] for k, axis in enumerate(columns)}
    notes = _notes(record, axes, whole)
    return Occurrence(values, counts / counts.sum(), notes, tuple(irregular))


def _notes(record: xr.Dataset, axes: list[str], whole: NDArray[np.bool_]) -> tuple[str, ...]:
    """Notes on conversions, on unused quantities of a record, and on times without values; rows (rows,)."""
    names = [str(name) for name in record.data_vars]
    used = [name for name in names if axis_of(name, axes)]
    unused = [name for name in names if name not in used]
    if PEAK in used:  # the zero-upcrossing period describes the same property
        unused = [name for name in unused if name != "zero_crossing_period"]
    comments = (f"{n}: {record[n].attrs['comment']}" for n in used if "comment" in record[n].attrs)
    converted = record.attrs.get("conversions", "")
    lacking, time = int((~whole).sum()), record["time"].values[whole]
    dated = np.issubdtype(time.dtype, np.datetime64)
    lines = (
        f"converted: {converted}" if converted else "",
        *comments,
        f"not used, as the study has no such axis: {', '.join(unused)}" if unused else "",
        f"{counted(lacking, 'row')} of the record without a value, not counted" if lacking else "",
        uneven_months(time.astype("datetime64[s]")) if dated else "",
    )
    return tuple(line for line in lines if line)


def axis_of(name: str, axes: list[str]) -> str | None:
    """The axis of a study to which a column belongs, by its name or another usual name."""
    if name in axes:
        return name
    alike = next((names for names in ALSO if name in names), ())
    ends = tuple(f"_{one}" for one in alike)  # axes of a sweep, such as wave_significant_height
    return next((a for a in axes if a.lower() in alike or a.lower().endswith(ends)), None)


def _head(path: Path, text: str) -> tuple[str, str]:
    match = _HEAD.fullmatch(text)
    if match is None:
        found = "this is not a heading with name and unit"
        raise InputError(path, text.strip(), found, "write, for example, 'hs (m)'")
    return match["name"].strip().lower().replace(" ", "_"), (match["unit"] or "").strip()


def _factor(path: Path | str, text: str, unit: str, of_axis: str) -> float:
    """Conversion factor from a column's unit to the unit of an axis, in CF notation."""
    if not unit:
        allowed = f"write the unit after the name: '{text.strip()} ({of_axis})'"
        raise InputError(path, text.strip(), "the heading has no unit", allowed)
    try:
        return unit_factor(unit, scene_notation(of_axis))
    except UnitFault as fault:
        allowed = fault.remedy or f"use a unit such as {of_axis}"
        raise InputError(path, text.strip(), f"the unit {unit!r} {fault.found}", allowed) from None


def _number(path: Path, row: int, column: str, cell: str) -> float:
    value = number_in(cell)
    if value is None or not math.isfinite(value):
        raise InputError(f"{path}, row {row}", column.strip(), f"{cell!r} is not a number", "write a number")
    return value


def _summed(path: Path, shares: FloatArray) -> tuple[str, ...]:
    total = float(shares.sum())
    if total > 1.0 + WHOLE:
        raise InputError(
            path, "", f"shares of the time add up to {100 * total:.4g} %", "reduce them to at most 100 %"
        )
    if not total > 0.0:
        raise InputError(path, "", "no sea state occurs", "give shares above 0")
    if total < 1.0 - WHOLE:
        return (f"{100 * (1 - total):.3g} % of the time is not in {path.name} and does no damage",)
    return ()


def within(
    of: Occurrence, grid: Mapping[str, FloatArray], calm: bool, units: Mapping[str, str]
) -> Occurrence:
    """Sea states within the range that a study simulates.

    Angles outside this range are changed by whole turns if they are then within it. Raises InputError when
    sea states are outside the range, with axis, share of the time and largest value.

    Parameters
    ----------
    grid : increasing values of the study by axis.
    calm : replace heights, periods and speeds below the smallest simulated value by it; otherwise, and for
        all other quantities, they are refused, like those above.
    units : units of the axes.
    """
    values, notes = dict(of.values), [*of.notes]
    for axis, places in grid.items():
        values[axis] = _turned(values[axis], places, TURNS.get(units[axis]))
        there = values[axis][of.shares > 0.0]
        low, high = float(places[0]), float(places[-1])
        slack = 1e-9 * max(abs(low), abs(high))
        below, above = values[axis] < low - slack, values[axis] > high + slack
        least = (
            0.0 if _can_be_calm(units[axis]) and low >= 0.0 else math.inf
        )  # smallest value that `calm` replaces
        if calm and below.any() and values[axis].min() >= least:
            notes.append(
                f"{axis} below {low:g}, {100 * of.shares[below].sum():.3g} % of the time, is set to {low:g}"
            )
            values[axis] = np.maximum(values[axis], low)
            below[:] = False
        outside = (below | above) & (of.shares > 0.0)
        if outside.any():
            raise InputError(
                "sea states",
                axis,
                f"in {100 * of.shares[outside].sum():.3g} % of the time, values are outside the simulated "
                f"range {low:g} to {high:g} (the sea states have {there.min():g} to {there.max():g})",
                f"simulate more values of {axis}"
                + (
                    ""
                    if above.any() or there.min() < least
                    else ", or add --calm to treat calmer seas as the calmest simulated sea"
                ),
            )
    return of._replace(values=values, notes=tuple(notes))


def _can_be_calm(unit: str) -> bool:
    """Whether a unit is one of heights, periods or speeds, in SI or another system."""
    return any(math.isfinite(factor_between(unit, of)) for of in OF_CALM)


def _turned(values: FloatArray, places: FloatArray, turn: float | None) -> FloatArray:
    """Angles (n,); those outside the range of places change by whole turns if they are then within it."""
    if turn is None:
        return values
    low, high = float(places[0]), float(places[-1])
    slack = 1e-9 * turn
    outside = (values < low - slack) | (values > high + slack)
    other = low - slack + (values - low + slack) % turn
    return np.where(outside & (other <= high + slack), other, values)
