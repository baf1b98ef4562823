"""Convert response amplitude operators (RAOs) from a Capytaine dataset (netCDF) to the table of a scene.

Headings are directions towards which waves travel. Phases lag the crest at the origin, as Capytaine's time
factor is exp(-i w t).

References
----------
Ancellin and Dias 2019, Capytaine: a Python-based linear potential flow solver, Journal of Open Source
Software 4(36), 1341.
"""

from __future__ import annotations

import cmath
import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from riserstudy.dataset.netcdf import load
from riserstudy.errors import InputError
from riserstudy.importers.operators import HEADING, SAME, Operators, columns_of, once_a_turn
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.rao import MOTIONS

if TYPE_CHECKING:
    import xarray as xr

FREQUENCIES = {"omega": ("frequency", "rad/s"), "freq": ("frequency", "Hz"), "period": ("period", "s")}
COMPLEX = "give the dimension complex the two values re and im"
#: units that attributes may state, and their factors to the units of the table
KNOWN: dict[str, dict[str, float]] = {
    "rad/s": dict.fromkeys(("", "rad/s", "rads/s", "rad s-1", "rad.s-1", "rad s^-1"), 1.0)
    | dict.fromkeys(("hz", "1/s"), 2.0 * math.pi),
    "Hz": dict.fromkeys(("", "hz", "1/s", "s-1", "s^-1"), 1.0),
    "s": dict.fromkeys(("", "s", "sec", "second", "seconds"), 1.0),
    "deg": dict.fromkeys(("", "rad", "rads"), math.degrees(1.0))
    | dict.fromkeys(("deg", "degree", "degrees"), 1.0),
}


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
    columns = [f"{name} ({unit})", HEADING, *columns_of([m for m in dofs.values() if m])]
    return once_a_turn(path, Operators(columns, table, "lag", left_out))


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
