"""Comparison of a run with a file of another program or measurement: series over time, or along the riser."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from riserstudy.dataset.external.columns import Column, in_si
from riserstudy.dataset.external.read import read_external
from riserstudy.dataset.lag import lag
from riserstudy.dataset.wall_tension import Added, Walls
from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.resolve import Resolved

FEWEST = 4  # smallest number of rows for a comparison
# share of the riser's length within which two places are equal: the digits of a heading
SAME = 1e-6
# share of an interval of outputs or stations by which a written number is rounded
ROUNDED = 1e-3
WALL, EFFECTIVE = "wall_tension", "effective_tension"
#: quantities that other programs define differently from a run
OTHERWISE = {"end_force": "write `effective_tension at 0 m`, which is the force at that end"}
DIFFERS = "a run defines this quantity differently"


class Pair(NamedTuple):
    """A column of the other file and the run, in the run's unit.

    Attributes
    ----------
    title : name of the column in the file. name : name of the run's variable, with its place.
    axis : "time" or "s".
    along : (n,), time (s) or arclength from the bottom (m) at which both are known.
    theirs, ours : (n,), values of the file and of the run.
    notes : how they were made comparable: conversions, interpolations and omissions.
    """

    title: str
    name: str
    axis: str
    unit: str
    along: FloatArray
    theirs: FloatArray
    ours: FloatArray
    notes: list[str]


class Compared(NamedTuple):
    """All columns of a file, and notes on how it was read."""

    pairs: list[Pair]
    notes: list[str]


class Difference(NamedTuple):
    """Difference of two series: the run minus the table, in the run's unit.

    Attributes
    ----------
    rms : root mean square of the difference. relative: divided by the range of the table, NaN if the table
        does not vary.
    largest, at : the difference with the largest magnitude, and its position along the axis.
    peak, low : difference of the largest and of the smallest values.
    lag : time (s) by which the run is later, for the best fit; NaN along the riser, or if one does not vary.
        rms_in_phase : root mean square after removal of this lag.
    """

    rms: float
    relative: float
    largest: float
    at: float
    peak: float
    low: float
    lag: float
    rms_in_phase: float


def compared(
    run: xr.Dataset,
    path: Path,
    *,
    scene: Resolved | None = None,
    called: Mapping[str, str] | None = None,
    end_a: str | None = None,
) -> Compared:
    """Every column of a file, paired with the run's values.

    Raises InputError when the file cannot be read, a heading names no variable of the run, or they do not
    overlap.

    Parameters
    ----------
    run : one point of a dataset.
    scene : scene of this point; absent: wall tension is refused.
    called : headings in the terms of a run, by the names of the columns in the file.
    end_a : where OrcaFlex's arc length begins: "top", "bottom", or such as "872 m down".
    """
    known = [run[dim].values for dim in ("s", "s_node") if dim in run.dims and run.sizes[dim]]
    length = max((float(values[-1]) for values in known), default=0.0)
    external = read_external(path, called or {}, end_a, length)
    pairs = [_pair(run, scene, path, external.axis, column) for column in external.columns]
    return Compared(pairs, external.notes)


def _pair(run: xr.Dataset, scene: Resolved | None, path: Path, axis: str, column: Column) -> Pair:
    title, (name, place, unit, size, cylinder) = column.title, column.heading
    if name in OTHERWISE:
        raise InputError(path, title, DIFFERS, OTHERWISE[name])
    wall = name.startswith(WALL)
    name = name.replace(WALL, EFFECTIVE, 1) if wall else name
    dim = _dim(run, path, axis, title, name)
    ours, notes = _sized(run, name) if size else (run[name], [])
    if place is not None:
        ours, between = _at(path, title, ours, place)
        notes += [f"the run is interpolated {between}"] if between else []
    if cylinder is not None:
        ours = _of_cylinder(path, title, ours, cylinder)
    if ours.ndim != 1:
        found = f"{name} of the run depends on {' and '.join(map(str, ours.dims))}"
        where = "cylinder 0" if "cylinder" in ours.dims else "300 m"
        raise InputError(path, title, found, f"give the place in the heading: `{name} at {where} ({unit})`")
    stored = str(run[name].attrs.get("units", "1"))
    along, theirs = column.along, in_si(path, title, column.values, unit, stored)
    known = run[dim].values.astype(float)
    inside, left_out = _inside(along, known, axis)
    along, theirs = np.clip(along[inside], known[0], known[-1]), theirs[inside]
    notes += left_out
    if wall:
        added = _walls(run, scene, path, title, axis, place, along)
        theirs, notes = theirs + added.force, [*notes, *added.notes, *added.left_out]
        left_out += added.left_out
    mine = np.interp(along, known, ours.values.astype(float))
    if not _at_known(along, known).all():
        notes.append(f"the run is interpolated over {axis}")
    there, without = _both(theirs, mine)
    notes, left_out = notes + without, left_out + without
    if there.sum() < FEWEST:
        found = f"only {int(there.sum())} rows have numbers between {known[0]:g} and {known[-1]:g}, where "
        found += "the run has results"
        why = "".join(f"; {note}" for note in left_out)
        raise InputError(path, title, found, f"give at least {FEWEST} rows there{why}")
    where = "" if place is None else f" at {place:g} m"
    where = where if cylinder is None else f" at cylinder {cylinder}"
    return Pair(title, name + where, axis, stored, along[there], theirs[there], mine[there], notes)


def _dim(run: xr.Dataset, path: Path, axis: str, title: str, name: str) -> str:
    """Dimension of the run's variable that corresponds to the table's axis."""
    dims = ("time",) if axis == "time" else ("s_node", "s")
    filled = {str(n) for n in run.data_vars if run[n].size}
    found = next((d for d in dims if name in filled and d in run[name].dims), None)
    if found is None:
        there = sorted(n for n in filled if set(dims) & set(run[n].dims))
        allowed = f"use one of {', '.join(there)}" if there else "give a table over the other axis"
        raise InputError(path, title, f"the run has no {name} over {axis}", allowed)
    return found


def _sized(run: xr.Dataset, name: str) -> tuple[xr.DataArray, list[str]]:
    """The magnitude of a variable of the run; for an extreme, the extreme of the magnitude."""
    stem, _, side = name.rpartition("_")
    values: xr.DataArray
    if side == "max" and f"{stem}_min" in run:
        values = xr.ufuncs.maximum(abs(run[name]), abs(run[f"{stem}_min"]))
    elif side == "min":
        low, high = run[name], run[f"{stem}_max"]
        values = xr.ufuncs.minimum(abs(low), abs(high)).where((low > 0.0) | (high < 0.0), 0.0)
    else:
        values = abs(run[name])
    return values.assign_attrs(run[name].attrs), [
        "the file has magnitudes, so the magnitude of the run is used"
    ]


def _inside(along: FloatArray, known: FloatArray, axis: str) -> tuple[NDArray[np.bool_], list[str]]:
    """For each row, whether it is within the range of the run; a note on rows outside."""
    inside = (along >= known[0]) & (along <= known[-1]) | _at_known(along, known)
    if inside.all():
        return inside, []
    span = f"{axis} from {known[0]:g} to {known[-1]:g}"
    return inside, [f"left out: {int((~inside).sum())} of {len(along)} rows, beyond the run's {span}"]


def _at_known(along: FloatArray, known: FloatArray) -> NDArray[np.bool_]:
    """For each row, whether it is at a time or place of the run but for the rounding of a written number."""
    if len(known) < 2:
        return np.isin(along, known)
    before = np.clip(np.searchsorted(known, along) - 1, 0, len(known) - 2)
    interval = known[before + 1] - known[before]
    apart = np.minimum(abs(along - known[before]), abs(along - known[before + 1]))
    return np.asarray(apart <= ROUNDED * interval)


def _both(theirs: FloatArray, ours: FloatArray) -> tuple[NDArray[np.bool_], list[str]]:
    """For each row, whether both have a number; notes on other rows."""
    notes = []
    for whose, values in (("the file", theirs), ("the run", ours)):
        missing = int((~np.isfinite(values)).sum())
        if missing:
            notes.append(f"left out: {missing} of {len(values)} rows, where {whose} has no number")
    return np.isfinite(theirs) & np.isfinite(ours), notes


def _walls(
    run: xr.Dataset,
    scene: Resolved | None,
    path: Path,
    title: str,
    axis: str,
    place: float | None,
    along: FloatArray,
) -> Added:
    """The difference of effective tension and wall tension (N), with notes on how it was computed."""
    if scene is None:
        found = "is wall tension, and the dataset has no scene from which effective tension is computed"
        allowed = "compute T_e = T_w + p_o A_o - p_i A_i yourself, and name the column effective_tension"
        raise InputError(path, title, found, allowed)
    walls = Walls(run, scene, path, title)
    return walls.along(along) if axis == "s" else walls.over_time(place or 0.0, along)


def _at(path: Path, title: str, values: xr.DataArray, place: float) -> tuple[xr.DataArray, str]:
    """Values at a place along the riser, linear between stations, and the names of these stations."""
    dim = next((d for d in ("s", "s_node") if d in values.dims), None)
    if dim is None:
        found = "is not a quantity along the riser"
        raise InputError(path, title, found, "remove `at ... m` from the heading")
    stations = values[dim].values
    near = SAME * stations[-1]
    if not stations[0] - near <= place <= stations[-1] + near:
        allowed = f"give a place from {stations[0]:g} m to {stations[-1]:g} m"
        raise InputError(path, title, f"{place:g} m is not on the riser", allowed)
    nearest = int(np.argmin(np.abs(stations - place)))
    if abs(stations[nearest] - place) <= SAME * stations[-1]:
        return values.isel({dim: nearest}, drop=True), ""
    below, above = stations[stations < place][-1], stations[stations > place][0]
    return values.interp({dim: place}).drop_vars(dim), f"between {below:g} and {above:g} m"


def _of_cylinder(path: Path, title: str, values: xr.DataArray, cylinder: int) -> xr.DataArray:
    """Values of one of the tensioners' cylinders."""
    if "cylinder" not in values.dims:
        found = "is not a quantity of a cylinder"
        raise InputError(path, title, found, "remove `at cylinder ...` from the heading")
    if cylinder not in values["cylinder"]:
        allowed = f"give a number from 0 to {values.sizes['cylinder'] - 1}"
        raise InputError(path, title, f"the run has no cylinder {cylinder}", allowed)
    return values.sel(cylinder=cylinder, drop=True)


def difference(pair: Pair) -> Difference:
    """The difference of the run and the table."""
    off = pair.ours - pair.theirs
    k = int(np.argmax(abs(off)))
    span = float(np.ptp(pair.theirs))
    rms = float(np.sqrt(np.mean(off**2)))
    moving = pair.axis == "time"
    delay, in_phase = lag(pair.along, pair.ours, pair.theirs) if moving else (math.nan, math.nan)
    return Difference(
        rms,
        rms / span if span else math.nan,
        *(float(off[k]), float(pair.along[k])),
        *(float(pair.ours.max() - pair.theirs.max()), float(pair.ours.min() - pair.theirs.min())),
        *(delay, in_phase),
    )
