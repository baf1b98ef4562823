"""Columns of another file in the terms of a run: text with headings of a run or OrcaFlex, or time series."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from riserstudy.dataset.external import columns as own
from riserstudy.dataset.external import orcaflex
from riserstudy.dataset.external.columns import Column, External, Heading
from riserstudy.dataset.external.qats_files import ENDINGS, read_series
from riserstudy.dataset.external.text import Text, read_table
from riserstudy.errors import InputError

AXES = {"time": "s", "s": "m"}  # possible first columns, with their SI units
NO_END_A = "omit it; only OrcaFlex results by arc length have an end A"
AXIS = "begin with `time (s)` or `s (m)`, or name the variable with --column"


def read_external(path: Path, called: Mapping[str, str], end_a: str | None, length: float) -> External:
    """Read a file.

    Raises InputError when the file cannot be read, or a heading is not known.

    Parameters
    ----------
    called : headings in the terms of a run, by the names of the columns in the file; if given, all other
        columns are ignored.
    end_a : origin of OrcaFlex's arc length, see ``orcaflex.end_a``.
    length : length of the riser (m).
    """
    if path.suffix.lower() in ENDINGS:
        if end_a is not None:
            raise InputError("--end-a", end_a, "has no effect on this file", NO_END_A)
        return _series(path, called)
    table = read_table(path)
    if repeated := {title for title in table.headings if table.headings.count(title) > 1}:
        raise InputError(
            path, sorted(repeated)[0], "two columns have this heading", "write each heading once"
        )
    if unknown := [title for title in called if title not in table.headings]:
        allowed = f"use one of {', '.join(table.headings)}"
        raise InputError("--column", unknown[0], "the file has no heading of this name", allowed)
    return _table(path, table, called, end_a, length)


def _series(path: Path, called: Mapping[str, str]) -> External:
    """Series over time, each with the heading that the user gives."""
    if not called:
        found = f"the names of series in a {path.suffix} file do not state which variable of a run they are"
        allowed = "state it with --column, such as --column 'NAME=effective_tension at 300 m (kN)'"
        raise InputError(path, "", found, allowed)
    found_series = read_series(path, [*called])
    made = [
        Column(
            one.title,
            own.heading_of(path, called[one.title]),
            own.rising(path, f"time of {one.title}", one.time),
            one.values,
        )
        for one in found_series
    ]
    notes = ["times are taken in s, values in the units of --column: the file states no units"]
    if any(one.unit for one in found_series):
        units = ", ".join(f"{one.title} {one.unit}" for one in found_series if one.unit)
        notes = [f"times are taken in s, values in the units of --column; the file states {units}"]
    return External("time", own.only_once(path, made), notes)


def _table(path: Path, table: Text, called: Mapping[str, str], end_a: str | None, length: float) -> External:
    title, *titles = table.headings
    axis, unit, foreign = _axis(path, title, called)
    end = orcaflex.end_a(end_a, length) if end_a is not None else None
    named = [] if called else titles
    theirs = (orcaflex.heading_of(path, name, table.above, end, length) for name in named)
    if end_a is not None and not foreign and not any(theirs):
        raise InputError("--end-a", end_a, "has no effect on this file", NO_END_A)
    along = own.in_si(path, title, table.columns[0], unit, AXES[axis])
    values, notes = table.columns[1:], [*table.notes]
    if foreign and axis == "s":
        if end is None:
            found = "the file does not state which end is end A"
            raise InputError(path, title, found, f"add --end-a: {orcaflex.END_A}")
        along = end.s + end.way * along
        order = slice(None, None, end.way)
        along, values = along[order], [column[order] for column in values]
        notes.append(f"arc length is measured {'up' if end.way > 0 else 'down'} from s = {end.s:g} m")
    own.rising(path, title, along)
    made = []
    for name, numbers in zip(titles, values, strict=True):
        if not called or name in called:
            heading = _heading(path, name, table, called, end, length)
            made.append(Column(name, heading, along, np.asarray(numbers)))
    left = [name for name in titles if called and name not in called]
    notes += [f"left out, as --column does not name them: {', '.join(left)}"] if left else []
    if not made:
        found = "the first column is the axis and cannot be compared"
        raise InputError("--column", title, found, "name another column")
    return External(axis, own.only_once(path, made), notes)


def _axis(path: Path, title: str, called: Mapping[str, str]) -> tuple[str, str, bool]:
    """Axis, unit, and whether the heading is in OrcaFlex's terms."""
    if title not in called and (theirs := orcaflex.axis_of(title)) and title.lower() != title:
        return *theirs, True
    heading = own.heading_of(path, called.get(title, title))
    if heading.name not in AXES or heading.place is not None:
        raise InputError(path, title, "the first column is not an axis", AXIS)
    return heading.name, heading.unit, False


def _heading(
    path: Path, title: str, table: Text, called: Mapping[str, str], end: orcaflex.EndA | None, length: float
) -> Heading:
    if title in called:
        return own.heading_of(path, called[title])
    theirs = orcaflex.heading_of(path, title, table.above, end, length)
    return theirs or own.heading_of(path, title)
