"""A column of another file: its quantity, place along the riser, unit and numbers.

The heading of a column names a variable of the run, its place along the riser, and the unit:
``effective_tension at 300 m (kN)``. The first column is ``time (s)``, or ``s (m)`` for values along the
riser.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from riserstudy.dataset.unit_systems import AS_STORED
from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.units import UnitFault, factor

_NUMBER = r"-?(?:\d+\.?\d*|\.\d+)"
_LENGTHS = {"m": 1.0, "ft": 0.3048}
_PLACE = rf"(?P<place>{_NUMBER}(?:e[+-]?\d+)?) (?P<length>{'|'.join(_LENGTHS)})|cylinder (?P<cylinder>\d+)"
_HEADING = re.compile(
    rf"(?P<name>\w+)(?: at (?:{_PLACE}))?\s*(?:\((?P<unit>[^()]+)\)|\[(?P<other>[^][]+)\])", re.ASCII
)
SI = {stored: written for written, stored in AS_STORED.items()} | {"Pa": "N/m^2"}
EXAMPLE = "write, for example, `effective_tension at 300 m (kN)`"


class Heading(NamedTuple):
    """Content of a heading: variable, arclength from the bottom (m) or None, unit."""

    name: str
    place: float | None
    unit: str
    size: bool = False  # whether the column is the magnitude of a quantity that has a sign in a run
    cylinder: int | None = None  # index of the tensioner cylinder, from 0, or None


class Column(NamedTuple):
    """Numbers of another file over time (s) or arclength from the bottom (m), in the file's unit.

    Attributes
    ----------
    title : name in the file.
    along, values : (n,); a missing value is NaN.
    """

    title: str
    heading: Heading
    along: FloatArray
    values: FloatArray


class External(NamedTuple):
    """The content of another file."""

    axis: str  # "time" or "s"
    columns: list[Column]
    notes: list[str]  # notes on how it was read, a line each


def heading_of(path: Path, text: str) -> Heading:
    """The content of a heading in the terms of a run. Raises InputError when the text is no such heading."""
    found = _HEADING.fullmatch(text.strip())
    if not found:
        raise InputError(path, text, "is not a heading with a unit", EXAMPLE)
    place = None if found["place"] is None else float(found["place"]) * _LENGTHS[found["length"]]
    cylinder = None if found["cylinder"] is None else int(found["cylinder"])
    unit = (found["unit"] or found["other"]).strip()
    return Heading(found["name"], place, unit, cylinder=cylinder)


def in_si(path: Path, title: str, values: FloatArray, unit: str, stored: str) -> FloatArray:
    """Numbers converted to the unit of a variable of a dataset, in the same shape.

    Raises InputError when the unit is not known, or has another dimension.
    """
    si = SI.get(stored, stored)
    if unit in (si, stored):
        return values
    # kN.m, as in files of other programs, and kN m
    product = re.sub(r"(?<=[A-Za-z])[.·]\s*(?=[A-Za-z])", "*", unit.replace("°", "deg"))
    try:
        return values * factor("*".join(product.split()), si)
    except UnitFault as fault:
        allowed = fault.remedy or f"write, for example, {si}"
        raise InputError(path, title, f"the unit {unit!r} {fault.found}", allowed) from None


def rising(path: Path, title: str, along: FloatArray) -> FloatArray:
    """Check times (s) or places (m), (n,), and return them.

    Raises InputError when a value is missing, or they do not increase.
    """
    missing = np.flatnonzero(~np.isfinite(along))
    if len(missing):
        found = f"row {missing[0] + 1} has no number"
        raise InputError(path, title, found, "write a number in each row of this column")
    falls = np.flatnonzero(np.diff(along) <= 0.0)
    if len(falls):
        k = int(falls[0])
        found = f"the values do not increase: {along[k + 1]:.10g} follows {along[k]:.10g} in row {k + 2}"
        raise InputError(path, title, found, "sort the rows, with each time or place once")
    return along


def only_once(path: Path, columns: list[Column]) -> list[Column]:
    """Check columns, and return them.

    Raises InputError when two columns are the same variable at the same place.
    """
    seen: dict[tuple[str, float | None, int | None], str] = {}
    for column in columns:
        heading = column.heading
        key = (heading.name, heading.place, heading.cylinder)
        if key in seen:
            found = f"gives the same variable and place as {seen[key]!r}"
            raise InputError(path, column.title, found, "remove one of the two columns")
        seen[key] = column.title
    return columns
