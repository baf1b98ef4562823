"""Possible columns of a sea record: names, units, ranges, and their headers."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError
from riserstudy.scene.units import UnitFault, unit_factor


class Column(NamedTuple):
    """A quantity of a sea record."""

    name: str
    unit: str  # SI unit, as for `unit_factor`; "deg" is not converted
    long_name: str
    standard_name: str  # CF standard name
    least: float
    most: float
    names: tuple[str, ...]  # its names in headers, in lower case with underscores


COLUMNS = (
    Column(
        "significant_wave_height",
        "m",
        "significant wave height",
        "sea_surface_wave_significant_height",
        0.0,
        35.0,
        ("hs", "h_s", "hm0", "swh", "significant_height", "wave_height"),
    ),
    Column(
        "peak_period",
        "s",
        "peak period",
        "sea_surface_wave_period_at_variance_spectral_density_maximum",
        0.5,
        40.0,
        ("tp", "t_p", "wave_period_at_peak"),
    ),
    Column(
        "zero_crossing_period",
        "s",
        "mean zero-upcrossing period",
        "sea_surface_wave_zero_upcrossing_period",
        0.5,
        30.0,
        ("tz", "t_z", "t02", "tm02", "zero_up_crossing_period", "zero_upcrossing_period"),
    ),
    Column(
        "wave_from_direction",
        "deg",
        "direction that waves come from, clockwise from north",
        "sea_surface_wave_from_direction",
        0.0,
        360.0,
        ("mwd", "wave_direction_from", "mean_wave_direction_from"),
    ),
    Column("wind_speed", "m/s", "wind speed", "wind_speed", 0.0, 120.0, ("u10", "wind")),
    Column(
        "current_speed",
        "m/s",
        "speed of the current",
        "sea_water_speed",
        0.0,
        10.0,
        ("current", "surface_current_speed"),
    ),
)
NAMES = {name: one for one in COLUMNS for name in (one.name, *one.names)}
#: ambiguous headers, and the text of their remedy
UNSURE = {
    "period": "peak_period or zero_crossing_period; the peak period is about 1.3 times as long",
    "t": "peak_period or zero_crossing_period",
    "wave_period": "peak_period or zero_crossing_period",
    "mean_period": "zero_crossing_period, if it is the mean period between zero upcrossings",
    "direction": "wave_from_direction or wave_to_direction",
    "wave_direction": "wave_from_direction or wave_to_direction",
    "dir": "wave_from_direction or wave_to_direction",
}
WRITTEN_FOR_NONE = (99.0, 999.0, 9999.0)
# factor between adjacent rows beyond which a possible fill value is probably not a value
JUMP = 2.0
#: note on records with this header, which seldom contain other heights
UNSURE_HEIGHT = "wave_height is taken as the significant height, not as the height of the largest wave"
_HEAD = re.compile(r"\s*(?P<name>[^(\[]+?)\s*[(\[](?P<unit>[^)\]]*)[)\]]\s*")


def labels_of(one: Column) -> dict[str, str]:
    """CF attributes of a variable."""
    units = {"deg": "degree", "m/s": "m s-1"}.get(one.unit, one.unit)
    return {"units": units, "long_name": one.long_name, "standard_name": one.standard_name}


#: names of directions that waves travel to, half a turn from the directions that they come from
GOES_TO = ("wave_to_direction", "wave_direction_to", "mean_wave_direction_to")


class Head(NamedTuple):
    """A column of a file: its quantity (None if not known), and the conversion factor of its unit to SI."""

    quantity: Column | None
    heading: str
    factor: float
    unit: str
    turned: bool = False  # whether it is the direction that waves travel to


def plain(name: str) -> str:
    """A name in lower case with underscores."""
    return re.sub(r"\W+", "_", name.strip().lower()).strip("_")


def head(where: str, text: str) -> Head:
    """The column of a header such as ``hs (ft)``.

    Raises InputError when it is ambiguous, or has no unit of its dimension.
    """
    match = _HEAD.fullmatch(text)
    name, unit = (match["name"], match["unit"].strip()) if match else (text, "")
    key = plain(name)
    if key in UNSURE:
        raise InputError(where, text.strip(), "the heading is ambiguous", f"write {UNSURE[key]}")
    turned = key in GOES_TO
    quantity = NAMES["wave_from_direction"] if turned else NAMES.get(key)
    if quantity is None or key == "time":
        return Head(None, key, 1.0, unit)
    if not unit:
        allowed = f"write the unit after the name: '{quantity.name} ({quantity.unit})'"
        raise InputError(where, text.strip(), "the heading has no unit", allowed)
    if quantity.unit == "deg":
        if plain(unit) not in ("deg", "degree", "degrees", "degt", "deg_true", "degree_true"):
            raise InputError(where, text.strip(), f"the unit {unit!r} is not degrees", "give values in deg")
        return Head(quantity, key, 1.0, unit, turned)
    try:
        return Head(quantity, key, unit_factor(unit, quantity.unit), unit)
    except UnitFault as fault:
        allowed = fault.remedy or f"use a unit such as {quantity.unit}"
        raise InputError(where, text.strip(), f"the unit {unit!r} {fault.found}", allowed) from None


def check_fills(path: Path, values: NDArray[np.float64], one: Head) -> None:
    """Check that 99, 999 and 9999, which often mark missing values, are near the adjacent values.

    ``values``: (rows,) in the unit of the file; NaN for missing values. Raises InputError at the first
    possible fill value whose ratio to an adjacent value is not between one half and two.
    """
    quantity = one.quantity
    if quantity is None or quantity.unit == "deg":
        return
    possible = (values * one.factor >= quantity.least) & (values * one.factor <= quantity.most)
    some = np.isin(values, WRITTEN_FOR_NONE) & possible
    others = np.flatnonzero(np.isfinite(values) & ~some)
    if not some.any():
        return
    after = np.searchsorted(others, np.arange(len(values)))
    known = np.append(values[others], math.nan)
    neighbours = known[after], known[np.where(after > 0, after - 1, len(others))]
    near = np.any([(of >= values / JUMP) & (of <= values * JUMP) for of in neighbours], axis=0)
    if (some & ~near).any():
        row = int((some & ~near).argmax())
        found = f"{values[row]:g} {one.unit} is a possible value, but it is also used for a missing value"
        allowed = f"leave cells of missing values empty, or give the column in {_other(one)}"
        raise InputError(f"{path}, row {row + 2}", one.heading, found, allowed)


def _other(one: Head) -> str:
    """A unit in which no number of the column looks like a fill value."""
    unit = one.quantity.unit if one.quantity else ""
    return {"m/s": "km/h"}.get(unit, unit) if one.factor == 1.0 else unit
