"""Convert response amplitude operators (RAOs) from files of diffraction codes to the table of a scene.

It reads WAMIT's ``.4`` file (columns period or frequency, heading, mode, modulus, phase, real and imaginary
part) and a netCDF file of a Capytaine dataset. Headings in both are directions towards which waves travel.
WAMIT's phases lead the crest at the origin; Capytaine's phases lag it, as its time factor is exp(-i w t). The
axes are those of scenes: x, y to port of it, z up.

References
----------
WAMIT, Inc., WAMIT User Manual, chapters 3 and 4: motions are made dimensionless by the length ULEN.
Ancellin and Dias 2019, Capytaine: a Python-based linear potential flow solver, Journal of Open Source
Software 4(36), 1341.
"""

from __future__ import annotations

import cmath
import math
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.csv_files import write_csv
from riserstudy.dataset.netcdf import load
from riserstudy.errors import InputError
from riserstudy.inputs.number_cell import number_in
from riserstudy.scene.rao import MOTIONS

if TYPE_CHECKING:
    import xarray as xr

FloatArray = NDArray[np.float64]
# share by which modulus and phase may differ from real and imaginary part, as printed
ROUNDED = 2e-3
HEAVE = 3  # its mode
COLUMNS = 7  # of a ``.4`` file
SAME = 1e-4  # largest difference of headings that count as equal (deg)
SHORTEST = 4.0  # s: a file whose periods are all shorter probably has frequencies instead
HEADING = "heading (deg)"
FREQUENCIES = {"omega": ("frequency", "rad/s"), "freq": ("frequency", "Hz"), "period": ("period", "s")}


#: units that attributes may state, and their factors to the units of the table
COMPLEX = "give the dimension complex the two values re and im"
KNOWN: dict[str, dict[str, float]] = {
    "rad/s": dict.fromkeys(("", "rad/s", "rads/s", "rad s-1", "rad.s-1", "rad s^-1"), 1.0)
    | dict.fromkeys(("hz", "1/s"), 2.0 * math.pi),
    "Hz": dict.fromkeys(("", "hz", "1/s", "s-1", "s^-1"), 1.0),
    "s": dict.fromkeys(("", "s", "sec", "second", "seconds"), 1.0),
    "deg": dict.fromkeys(("", "rad", "rads"), math.degrees(1.0))
    | dict.fromkeys(("deg", "degree", "degrees"), 1.0),
}


class Operators(NamedTuple):
    """A table of RAOs in the form that a scene reads."""

    columns: list[str]  # with their units
    rows: list[list[float]]
    phases: str  # lead or lag
    left_out: list[str]


class Row(NamedTuple):
    """One number of a ``.4`` file."""

    period: float  # s
    heading: float  # deg
    mode: int  # 1 to 6: surge ... yaw
    value: complex  # a positive angle is a lead


def from_wamit(path: Path, length: float, first: Literal["period", "frequency"] | None = None) -> Operators:
    """Read the RAOs of a ``.4`` file; ``length`` is the length ULEN of its body (m).

    ``first``: whether the first column is the period (s) or the circular frequency (rad/s), WAMIT's input
    IPEROUT; None: the period, unless the numbers contradict it. Raises InputError when it is not such a file,
    contradicts itself, is incomplete, or when its first column is probably not the period.
    """
    rows = [*_rows_of_wamit(path)]
    if first == "frequency":
        rows = [row._replace(period=2.0 * math.pi / row.period if row.period else math.inf) for row in rows]
    waves = [row for row in rows if math.isfinite(row.period) and row.period > 0.0]
    left_out = [
        f"period {p:g}: no wave" for p in sorted({r.period for r in rows} - {r.period for r in waves})
    ]
    left_out += [f"mode {m}: no motion of a platform" for m in sorted({r.mode for r in waves if r.mode > 6})]
    values = {(r.heading, r.period, r.mode): r.value for r in waves if r.mode <= 6}
    if not values:
        allowed = "give a file with modes from 1 to 6 at periods above 0"
        raise InputError(path, "", "the file has no RAOs of platform motions", allowed)
    if len(values) < sum(row.mode <= 6 for row in waves):
        found = "two lines have the same period, heading and mode"
        raise InputError(path, "", found, "delete one of them")
    if first is None and (why := _no_periods(values)):
        allowed = "add --first-column period or --first-column frequency"
        raise InputError(path, "the first column", why, allowed)
    headings = sorted({heading for heading, _, _ in values})
    periods = sorted({period for _, period, _ in values})
    modes = sorted({mode for *_, mode in values})
    table = []
    for heading in headings:
        for period in periods:
            cells = [period, heading]
            for mode in modes:
                if (heading, period, mode) not in values:
                    found = f"mode {mode} has no line at {heading:g} deg and {period:g} s"
                    allowed = "give each mode a line for every heading and period"
                    raise InputError(path, "", found, allowed)
                value = values[heading, period, mode] / (length if mode > 3 else 1.0)
                cells += [abs(value), math.degrees(cmath.phase(value))]
            table.append(cells)
    names = [MOTIONS[mode - 1] for mode in modes]
    columns = ["period (s)", HEADING, *_columns(names)]
    return _once_a_turn(path, Operators(columns, table, "lead", left_out))


def _no_periods(values: dict[tuple[float, float, int], complex]) -> str:
    """Why numbers by heading, period (s) and mode are probably not by period; empty if they can be.

    A floating body follows long waves, and short waves hardly move it.
    """
    periods = sorted({period for _, period, _ in values})
    if periods[-1] < SHORTEST:
        return f"as periods, all are shorter than {SHORTEST:g} s: they may be frequencies"
    heave = dict.fromkeys(periods, 0.0)
    for (_, period, mode), value in values.items():
        if mode == HEAVE:
            heave[period] = max(heave[period], abs(value))
    shortest, longest = heave[periods[0]], heave[periods[-1]]
    if shortest > 2.0 * longest:
        return (
            f"as periods, heave is {shortest:.3g} m/m at {periods[0]:g} s but {longest:.3g} m/m at "
            f"{periods[-1]:g} s: they may be frequencies"
        )
    return ""


def _rows_of_wamit(path: Path) -> list[Row]:
    rows: list[Row] = []
    for number, line in enumerate(path.read_text("utf-8-sig", "replace").splitlines(), 1):
        words = line.split()
        numbers = [number_in(word.replace("D", "E").replace("d", "e")) for word in words]
        cells = [value for value in numbers if value is not None]
        if len(cells) < len(words):
            if rows or not _is_heading(words, len(cells)):
                found = f"{line.strip()[:40]!r} is not a line of numbers"
                raise InputError(path, f"line {number}", found, "write numbers only")
            continue
        if not cells:
            continue
        if len(cells) != COLUMNS or cells[2] != int(cells[2]):
            whole = f"the mode {cells[2]:g} is not a whole number" if len(cells) == COLUMNS else ""
            found = whole or f"the line has {len(cells)} numbers instead of {COLUMNS}"
            allowed = "write period, heading, mode, modulus, phase, real and imaginary part"
            raise InputError(path, f"line {number}", found, allowed)
        value, polar = complex(*cells[5:]), cmath.rect(cells[3], math.radians(cells[4]))
        if not abs(value - polar) <= ROUNDED * abs(value) + 1e-6:
            found = f"modulus and phase give {polar:.4g}, but real and imaginary part give {value:.4g}"
            raise InputError(path, f"line {number}", found, "check the order of the columns")
        rows.append(Row(cells[0], cells[1], int(cells[2]), value))
    return rows


def _is_heading(words: list[str], numbers: int) -> bool:
    """Return whether a line above the rows, of which so many words are numbers, is not an unreadable row.

    Codes print numbers too long for their column as asterisks, or without the space before the next number.
    """
    return numbers == 0 or (len(words) != COLUMNS and 2 * numbers < len(words))


def from_capytaine(path: Path) -> Operators:
    """Read the RAOs of a Capytaine dataset, which must have an ``RAO``.

    Raises InputError when it has none, or has several bodies.
    """
    dataset = _dataset(path)
    rao = _complex(path, dataset["RAO"])
    by = next((name for name in FREQUENCIES if name in rao.dims), None)
    if by is None or "radiating_dof" not in rao.dims:
        allowed = "give radiating_dof, wave_direction and one of omega, freq, period"
        found = f"the dimensions are {', '.join(map(str, rao.dims))}"
        raise InputError(path, "RAO", found, allowed)
    _refuse_speed(path, rao)
    dofs = _motions(path, [str(name) for name in rao["radiating_dof"].values])
    if "wave_direction" not in rao.coords:
        raise InputError(path, "wave_direction", "missing", "add the directions of the waves")
    if "wave_direction" not in rao.dims:
        rao = rao.expand_dims("wave_direction")
    extra = set(rao.dims) - {"radiating_dof", "wave_direction", by}
    if extra:
        raise InputError(
            path,
            "RAO",
            f"the RAOs have several values along {sorted(map(str, extra))[0]}",
            "select one of these values",
        )
    rao = rao.transpose("wave_direction", by, "radiating_dof")
    waves = _in_unit(path, rao[by], FREQUENCIES[by][1])
    headings = _headings(path, rao["wave_direction"])
    good = np.isfinite(waves) & (waves > 0.0)
    left_out = [f"{by} {wave:g}: no wave" for wave in waves[~good]]
    left_out += [f"{name}: no motion of a platform" for name, motion in dofs.items() if motion is None]
    left_out += [f"variable {name}" for name in dataset.data_vars if name != "RAO"]
    taken = [k for k, motion in enumerate(dofs.values()) if motion]
    table: list[list[float]] = []
    for heading, plane in zip(headings, rao.values, strict=True):
        for wave, values in zip(waves[good], plane[good], strict=True):
            if not np.isfinite(values[taken]).all():
                found = f"a value is missing at {heading:g} deg and {by} {wave:g}"
                raise InputError(path, "RAO", found, "remove this wave from the dataset")
            cells = [x for v in values[taken] for x in (abs(v), math.degrees(cmath.phase(v)))]
            table.append([float(wave), float(heading), *map(float, cells)])
    name, unit = FREQUENCIES[by]
    columns = [f"{name} ({unit})", HEADING, *_columns([m for m in dofs.values() if m])]
    return _once_a_turn(path, Operators(columns, table, "lag", left_out))


def _dataset(path: Path) -> xr.Dataset:
    """Return a dataset that has RAOs.

    Raises InputError when the file is no netCDF file or has none.
    """
    try:
        dataset = load(path)
    except (OSError, ValueError, RuntimeError) as error:
        raise InputError(
            path, "", f"this is not a netCDF file ({error})"[:80], "give a dataset of Capytaine"
        ) from None
    if "RAO" not in dataset:
        allowed = "add capytaine.post_pro.rao(dataset) to the dataset as the variable RAO"
        raise InputError(path, "RAO", "missing", allowed)
    return dataset


def _refuse_speed(path: Path, rao: xr.DataArray) -> None:
    """Refuse RAOs at a forward speed: those of a scene are the RAOs of a platform at rest."""
    speed = rao.coords.get("forward_speed")
    if speed is not None and speed.ndim == 0 and float(speed) != 0.0:
        allowed = "give RAOs for a forward speed of 0 m/s"
        found = f"the RAOs are for a forward speed of {float(speed):g} m/s"
        raise InputError(path, "forward_speed", found, allowed)


def _headings(path: Path, axis: xr.DataArray) -> FloatArray:
    """Return wave directions in degrees.

    Raises InputError for directions in radians of more than a turn, which are probably degrees.
    """
    headings = _in_unit(path, axis, "deg")
    largest = float(np.abs(headings).max())
    if not np.isfinite(headings).all():
        raise InputError(path, "wave_direction", "a value is missing", "give finite numbers")
    if largest > (1.0 + SAME) * 360.0:
        found = f"the largest direction, {largest:.4g} deg, is more than a full turn"
        allowed = "set the attribute units to 'deg' if the values are in degrees, or correct the values"
        raise InputError(path, "wave_direction", found, allowed)
    return headings


def _in_unit(path: Path, axis: xr.DataArray, unit: str) -> FloatArray:
    """Return the values of an axis, converted from the unit in its attribute; without one, Capytaine's unit.

    Raises InputError when the axis has no numbers or its unit is unknown.
    """
    if axis.name not in axis.coords or axis.dtype.kind not in "fiu":
        found = "the values are not numbers" if axis.name in axis.coords else "the coordinate has no values"
        raise InputError(path, str(axis.name), found, "give numbers as values of this coordinate")
    written = str(axis.attrs.get("units", "")).strip().lower().replace("radian", "rad")
    known = KNOWN[unit]
    if written not in known:
        allowed = f"use one of {', '.join(word for word in known if word)}"
        raise InputError(path, str(axis.name), f"the unit {written!r} is not known here", allowed)
    return np.asarray(axis.values * known[written], float)


def _complex(path: Path, rao: xr.DataArray) -> xr.DataArray:
    """Return the RAOs as complex numbers, which netCDF stores as two real numbers.

    Raises InputError when they have one part only, are no numbers, or state a unit that is not Capytaine's.
    """
    unit = str(rao.attrs.get("units", "")).strip()
    if unit not in ("", "1", "m/m"):
        allowed = "give m/m (translations) and rad/m (rotations), and remove the attribute units"
        raise InputError(path, "RAO", f"the unit {unit!r} is not one of Capytaine's", allowed)
    if "complex" not in rao.dims and rao.dtype.kind == "c":
        return rao
    if "complex" not in rao.dims or rao.dtype.kind not in "fiu":
        found = "the RAOs are not complex numbers" if rao.dtype.kind in "fiu" else "the RAOs are not numbers"
        raise InputError(path, "RAO", found, COMPLEX)
    parts = [str(part) for part in rao["complex"].values] if "complex" in rao.coords else []
    if sorted(parts) != ["im", "re"]:
        raise InputError(path, "RAO", f"the dimension complex has the parts {parts}", COMPLEX)
    return rao.sel(complex="re", drop=True) + 1j * rao.sel(complex="im", drop=True)


def _motions(path: Path, names: list[str]) -> dict[str, str | None]:
    """Return the motion of each degree of freedom, else None; names may have the body's name as a prefix."""
    bodies = {name.rpartition("__")[0] for name in names}
    if len(bodies) > 1:
        allowed = "select the degrees of freedom of the platform"
        raise InputError(path, "radiating_dof", f"the dataset has {len(bodies)} bodies", allowed)
    for name in names:
        if sum(other.lower() == name.lower() for other in names) > 1:
            raise InputError(path, "radiating_dof", f"{name} occurs twice", "give each motion once")
    short = {name: name.rpartition("__")[2].lower() for name in names}
    if not set(short.values()) & set(MOTIONS):
        found = f"none of {', '.join(names)} is a platform motion"
        raise InputError(path, "radiating_dof", found, f"use names such as {', '.join(MOTIONS)}")
    return {name: one if one in MOTIONS else None for name, one in short.items()}


def _once_a_turn(path: Path, found: Operators) -> Operators:
    """Return the RAOs without a heading that repeats another after a full turn, as in files to 360 deg.

    Raises InputError when the responses at these two headings differ.
    """
    if HEADING not in found.columns:
        return found
    tables: dict[float, list[list[float]]] = {}
    for row in found.rows:
        tables.setdefault(row[1], []).append(row)
    kept: dict[float, list[list[float]]] = {}
    for heading, rows in tables.items():
        twin = next((k for k in kept if abs(math.remainder(k - heading, 360.0)) < SAME), None)
        if twin is None:
            kept[heading] = rows
        elif _same(found.columns, kept[twin], rows):
            found.left_out.append(f"heading {heading:g} deg: that of {twin:g} deg")
        else:
            at = f"the response differs from the response at {twin:g} deg, which is the same heading"
            raise InputError(path, f"heading {heading:g} deg", at, "remove one of the two")
    return found._replace(rows=[row for rows in kept.values() for row in rows])


def _same(columns: list[str], one: list[list[float]], other: list[list[float]]) -> bool:
    """Return whether printed responses at two headings agree; rows of period, heading, sizes and phases.

    ``columns``: headings of the table. Displacements and rotations have different units, so each are compared
    with the largest of their kind.
    """
    if len(one) != len(other) or [row[0] for row in one] != [row[0] for row in other]:
        return False
    values = []
    for rows in (one, other):
        table = np.array(rows)
        values.append(table[:, 2::2] * np.exp(1j * np.radians(table[:, 3::2])))
    off, size = np.abs(values[0] - values[1]), np.abs(values[0])
    turns = np.array(["rad/m" in name for name in columns[2::2]])
    kinds = [kind for kind in (turns, ~turns) if kind.any()]
    return all(off[:, kind].max() <= ROUNDED * size[:, kind].max() for kind in kinds)


def _columns(motions: list[str]) -> list[str]:
    units = {name: "m/m" if name in MOTIONS[:3] else "rad/m" for name in motions}
    return [x for name in motions for x in (f"{name} ({units[name]})", f"{name}_phase (deg)")]


def write_table(found: Operators, target: Path) -> None:
    """Write RAOs as the CSV table that ``platform.response.operators`` reads."""
    write_csv(target, found.columns, ([f"{cell:.10g}" for cell in row] for row in found.rows))


def lines_of_scene(found: Operators, target: Path) -> str:
    """Return the lines that the scene needs in addition to the table."""
    headed = ", headings: towards" if HEADING in found.columns else ""
    return f"platform.response: {{operators: {{file: {target.name}}}, phases: {found.phases}{headed}}}"
