"""A run compared with a table of another program or of a measurement: series over time, or values along.

The heading of a column names a variable of the run, where along the riser it is, and the unit:
``effective_tension at 300 m (kN)``. The first column is ``time (s)``, or ``s (m)`` of values along the riser.
"""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from riserstudy.dataset.unit_systems import AS_STORED
from riserstudy.errors import InputError
from riserstudy.inputs.text import read_text
from riserstudy.scene.units import factor

FloatArray = NDArray[np.float64]
MOST_BYTES = 100_000_000
FEWEST = 4  # rows that are compared
ALIKE = 0.01  # of the table's variance, by which two lags fit alike
_HEADING = re.compile(r"(?P<name>\w+)(?: at (?P<place>-?[\d.]+) m)?\s*\((?P<unit>[^()]+)\)")
ALONG = {"time": "s", "s": "m"}  # what a first column may be, in its SI unit
#: what other programs print by another definition than a run has it
OTHERWISE = {
    "wall_tension": "convert it to effective tension, T_e = T_w - p_i A_i + p_o A_o, and name that",
    "end_force": "it is the effective tension at that end: write `effective_tension at 0 m`",
}
SI = {stored: written for written, stored in AS_STORED.items()} | {"Pa": "N/m^2"}


class Pair(NamedTuple):
    """A column of the table beside the run, in the run's unit.

    Attributes
    ----------
    along : (n,), time (s) or arclength from the bottom (m) at which both are known.
    theirs, ours : (n,).
    interpolated : what of the run was interpolated; "" where nothing was.
    """

    heading: str
    axis: str
    unit: str
    along: FloatArray
    theirs: FloatArray
    ours: FloatArray
    interpolated: str


class Difference(NamedTuple):
    """How two series differ: the run less the table, in the run's unit.

    Attributes
    ----------
    rms : root mean square of the difference. relative: over the range of the table, not a number where it
        does not vary.
    largest, at : the largest difference by size, and where along.
    peak, low : difference of the largest and of the smallest values.
    lag : time (s) by which the run is later, at which both correlate best; not a number along the riser and
        where one does not vary. rms_in_phase : root mean square with that lag taken out.
    """

    rms: float
    relative: float
    largest: float
    at: float
    peak: float
    low: float
    lag: float
    rms_in_phase: float


def pairs(run: xr.Dataset, path: Path) -> list[Pair]:
    """Every column of a table beside what a run has of it.

    Raises
    ------
    InputError
        When the table cannot be read, a heading names nothing of the run, or both overlap nowhere.
    """
    headings, columns = _table(path)
    axis, unit, _ = _parts(path, headings[0])
    if axis not in ALONG:
        raise InputError(path, headings[0], "is no axis", "begin with `time (s)` or `s (m)`")
    along = _in_si(path, headings[0], columns[0], unit, ALONG[axis])
    if np.any(np.diff(along) <= 0.0):
        raise InputError(path, headings[0], "does not rise from row to row", "sort the rows")
    return [
        _pair(run, path, axis, along, heading, values)
        for heading, values in zip(headings[1:], columns[1:], strict=True)
    ]


def _pair(
    run: xr.Dataset, path: Path, axis: str, along: FloatArray, heading: str, values: FloatArray
) -> Pair:
    name, unit, place = _parts(path, heading)
    if name in OTHERWISE:
        raise InputError(path, heading, "is defined otherwise than in a run", OTHERWISE[name])
    dim = (
        "time" if axis == "time" else next((d for d in ("s_node", "s") if _has(run, name, d)), "s")
    )
    if not _has(run, name, dim):
        there = ", ".join(sorted(str(n) for n in run.data_vars if dim in run[n].dims))
        raise InputError(
            path, heading, f"the run has no {name} over {axis}", f"allowed are {there}"
        )
    ours, said = run[name], []
    if place is not None:
        ours, at = _at(path, heading, ours, float(place))
        said += [at] if at else []
    if ours.ndim != 1:
        found = f"{name} is over {', '.join(map(str, ours.dims))}"
        raise InputError(path, heading, found, f"say where: `{name} at 300 m ({unit})`")
    stored = str(run[name].attrs.get("units", "1"))
    theirs = _in_si(path, heading, values, unit, SI.get(stored, stored))
    known = run[dim].values.astype(float)
    inside = (along >= known[0]) & (along <= known[-1]) & np.isfinite(theirs)
    if inside.sum() < FEWEST:
        found = f"{int(inside.sum())} rows lie between {known[0]:g} and {known[-1]:g}"
        raise InputError(path, heading, found, f"at least {FEWEST} are needed")
    along, theirs = along[inside], theirs[inside]
    said += [] if np.isin(along, known).all() else [f"over {axis}"]
    values_there = np.interp(along, known, ours.values.astype(float))
    return Pair(heading, axis, stored, along, theirs, values_there, " and ".join(said))


def _has(run: xr.Dataset, name: str, dim: str) -> bool:
    return name in run.data_vars and dim in run[name].dims


def _at(path: Path, heading: str, values: xr.DataArray, place: float) -> tuple[xr.DataArray, str]:
    """Values at a place along the riser, linear between stations; and what was interpolated."""
    dim = next((d for d in ("s", "s_node") if d in values.dims), None)
    if dim is None:
        raise InputError(path, heading, "is not along the riser", "leave `at ... m` out")
    stations = values[dim].values
    if not stations[0] <= place <= stations[-1]:
        allowed = f"allowed is {stations[0]:g} to {stations[-1]:g} m"
        raise InputError(path, heading, f"{place:g} m is not on the riser", allowed)
    if place in stations:
        return values.sel({dim: place}, drop=True), ""
    below, above = stations[stations < place][-1], stations[stations > place][0]
    return values.interp({dim: place}).drop_vars(dim), f"between {below:g} and {above:g} m"


def difference(pair: Pair) -> Difference:
    """How the run differs from the table."""
    off = pair.ours - pair.theirs
    k = int(np.argmax(abs(off)))
    span = float(np.ptp(pair.theirs))
    rms = float(np.sqrt(np.mean(off**2)))
    delay, in_phase = _lag(pair) if pair.axis == "time" else (math.nan, math.nan)
    return Difference(
        rms,
        rms / span if span else math.nan,
        *(float(off[k]), float(pair.along[k])),
        *(float(pair.ours.max() - pair.theirs.max()), float(pair.ours.min() - pair.theirs.min())),
        *(delay, in_phase),
    )


def _lag(pair: Pair) -> tuple[float, float]:
    """Time (s) by which the run is later, and the root mean square that is left when it is taken out.

    Searched over a quarter of the record either way, where as much as possible of both is compared.
    """
    step = float(np.min(np.diff(pair.along)))
    even = np.arange(pair.along[0], pair.along[-1] + 0.5 * step, step)
    ours, theirs = (np.interp(even, pair.along, v) for v in (pair.ours, pair.theirs))
    if not np.ptp(ours) or not np.ptp(theirs):
        return math.nan, math.nan
    shifts = range(-(len(even) // 4), len(even) // 4 + 1)
    left = [_left(*_shifted(ours, theirs, shift)) for shift in shifts]
    best = _nearest_least(left, shifts, ALIKE * float(np.var(theirs)))
    ours_there, theirs_there = _shifted(ours, theirs, shifts[best])
    rms = float(np.sqrt(np.mean((ours_there - theirs_there) ** 2)))
    return (shifts[best] + _between(left, best)) * step, rms


def _left(ours: FloatArray, theirs: FloatArray) -> float:
    """Mean square of a difference, its mean taken out."""
    return float(np.var(ours - theirs))


def _nearest_least(left: list[float], shifts: range, alike: float) -> int:
    """The least that is nearest to no shift: what repeats itself fits as well a period later."""
    least = min(left)
    ends = [np.inf, *left, np.inf]
    valleys = [k for k, here in enumerate(left) if here <= min(ends[k], ends[k + 2])]
    good = [k for k in valleys if left[k] <= least + alike]
    return min(good, key=lambda k: abs(shifts[k]))


def _shifted(ours: FloatArray, theirs: FloatArray, steps: int) -> tuple[FloatArray, FloatArray]:
    """Both where they overlap, the first taken so many steps earlier."""
    if steps >= 0:
        return ours[steps:], theirs[: len(theirs) - steps]
    return ours[:steps], theirs[-steps:]


def _between(left: list[float], best: int) -> float:
    """Where between steps the least lies, by a parabola through three values."""
    if not 0 < best < len(left) - 1:
        return 0.0
    before, here, after = left[best - 1 : best + 2]
    bend = before - 2.0 * here + after
    return 0.5 * (before - after) / bend if bend > 0.0 else 0.0


def _table(path: Path) -> tuple[list[str], list[FloatArray]]:
    rows = [row for row in csv.reader(read_text(path, MOST_BYTES).splitlines()) if row]
    if len(rows) < 2 or len(rows[0]) < 2:
        raise InputError(path, "", "no table of two columns", "write a heading and rows below it")
    headings = [cell.strip() for cell in rows[0]]
    numbers = []
    for line, row in enumerate(rows[1:], 2):
        if len(row) != len(headings):
            found = f"{len(row)} cells, {len(headings)} headings"
            raise InputError(path, f"line {line}", found, "write a cell for each heading")
        try:
            numbers.append([float(cell) if cell.strip() else math.nan for cell in row])
        except ValueError as error:
            raise InputError(path, f"line {line}", str(error), "allowed are numbers") from None
    return headings, [*np.array(numbers).T]


def _parts(path: Path, heading: str) -> tuple[str, str, str | None]:
    """Name, unit and place of a heading."""
    found = _HEADING.fullmatch(heading)
    if not found:
        allowed = "write, for example, `effective_tension at 300 m (kN)`"
        raise InputError(path, heading, "is no heading with a unit", allowed)
    return found["name"], found["unit"].strip(), found["place"]


def _in_si(path: Path, heading: str, values: FloatArray, unit: str, si: str) -> FloatArray:
    if unit == si or (unit, si) == ("1", "1"):
        return values
    try:
        return values * factor(unit.replace(" ", "*"), si)
    except ValueError as error:
        raise InputError(
            path, heading, f"unit {unit!r} {error}", f"allowed is such as {si}"
        ) from None
