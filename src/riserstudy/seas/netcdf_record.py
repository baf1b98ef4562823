"""Sea states from netCDF, by CF names, or by the names in ERA5, WAVEWATCH III, NORA3 and NDBC.

The library wavespectra converts spectra to heights, periods and directions. Its readers know the units of
each source, and whether its directions are where waves come from or travel to.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from riserstudy.dataset.netcdf import load
from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray
from riserstudy.seas.columns import COLUMNS, NAMES, UNSURE_HEIGHT, Column, check_fills, head, plain
from riserstudy.seas.valid_ranges import quality_flags, within_valid_range
from riserstudy.seas.zones import check_zone

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

CLOCKS = ("time", "valid_time")
STARTS = "forecast_reference_time"
#: names in these sources that are not used in headers of tables
SOURCES = {
    "mp2": "zero_crossing_period",  # ERA5
    "pp1d": "peak_period",
    "dominant_wpd": "peak_period",  # NDBC
    "average_wpd": "zero_crossing_period",
    "mean_wave_dir": "wave_from_direction",
    "wind_spd": "wind_speed",
    "tm2": "zero_crossing_period",  # NORA3
    "ff": "wind_speed",
}
#: speeds that are given by components towards east and north
PARTS = {"wind_speed": (("u10", "v10"), ("uwnd", "vwnd")), "current_speed": (("ucur", "vcur"),)}
PEAK_FREQUENCY = "sea_surface_wave_frequency_at_variance_spectral_density_maximum"
GOES_TO = "sea_surface_wave_to_direction"
COMES_FROM = "sea_surface_wave_from_direction"
#: attribute of peak periods that were converted from zero-upcrossing periods with this gamma (1)
CONVERTED = "peak_enhancement"
HEIGHT = "significant_wave_height"  # the quantity that every record has
#: ambiguous names of directions
UNSURE = ("dir", "thq", "pdir", "dp", "dm", "wave_direction")
SPELT = {
    **dict.fromkeys(("meters", "meter", "metres", "metre"), "m"),
    **dict.fromkeys(("seconds", "second"), "s"),
    **dict.fromkeys(("meters/second", "meters per second", "m s-1", "m s**-1"), "m/s"),
    **dict.fromkeys(("degrees_true", "degree_true", "degrees", "degree", "degree true"), "deg"),
}
EARTH = 111.2  # km in a degree of latitude


class Place(NamedTuple):
    """A place at which a file with several places is read (degrees north and east)."""

    latitude: float
    longitude: float


def read_netcdf(path: Path, near: Place | None) -> tuple[pd.DataFrame, str]:
    """Columns of a record by time, and notes on conversions and omissions.

    ``near``: place; the nearest place of a file with several is read; absent: the file has one place. Raises
    InputError when the file cannot be read, or has no times; when it has several places and ``near`` is
    absent; when the wave height has several values at a time; when a direction is ambiguous: where waves come
    from, or travel to.
    """
    import pandas as pd

    try:
        data = load(path, decode_timedelta=False)
    except (OSError, ValueError, RuntimeError) as error:
        found = f"the file cannot be read as netCDF: {error}"
        raise InputError(path, "", found, "give a netCDF file with times") from None
    flags = quality_flags(data)
    data, notes = _at_one_place(path, within_valid_range(data), near)
    notes += [f"left out: quality flags {', '.join(flags)}"] if flags else []
    if spectral := _spectra(data):
        data, note = _of_spectra(path, data, spectral)
        notes.append(note)
    clock = _clock(data)
    if clock is None:
        raise _without_times(path, data)
    check_zone(path, data[clock], clock, data.attrs)
    columns: dict[str, FloatArray] = {}
    for one, values, note in _columns(path, data, clock):
        if one.name in columns:
            if not np.array_equal(columns[one.name], values, equal_nan=True):
                notes.append(f"left out: a second variable of {one.name}")
            continue
        columns[one.name] = values
        notes += [note] if note else []
    if HEIGHT not in columns:
        _refuse_several(path, data, clock)
    if unused := _unused(path, data.drop_vars(flags, errors="ignore"), clock):
        notes.append(f"left out: {', '.join(unused)}")
    times = pd.DatetimeIndex(data[clock].values, name="time")
    frame = pd.DataFrame(columns, times)
    if CONVERTED in (about := data["peak_period"].attrs if "peak_period" in data else {}):
        frame.attrs[CONVERTED] = float(about[CONVERTED])
    return frame, "; ".join(notes)


def _refuse_several(path: Path, data: xr.Dataset, clock: str) -> None:
    """Raise InputError when the wave height has several values at a time, such as those of stations."""
    for name, values in data.data_vars.items():
        standard = str(values.attrs.get("standard_name", ""))
        found = _by_standard(standard) or _by_name(path, str(name), standard)
        if found is None or found.name != HEIGHT or data[clock].dims[0] not in values.dims:
            continue
        others = [f"{data.sizes[dim]} of {dim}" for dim in values.dims if dim not in data[clock].dims]
        allowed = (
            "write one of them to a separate file, or add latitudes and longitudes to the file for --near"
        )
        why = f"the file has several values for each time: {', '.join(others)}"
        raise InputError(path, str(name), why, allowed)


def _unused(path: Path, data: xr.Dataset, clock: str) -> list[str]:
    """Variables over time that are no quantity of a record, or have further dimensions."""
    parts = [pair for pairs in PARTS.values() for pair in pairs if {*pair} <= {*data.data_vars}]
    names = []
    for name, values in data.data_vars.items():
        standard = str(values.attrs.get("standard_name", ""))
        if data[clock].dims[0] not in values.dims or any(name in pair for pair in parts):
            continue
        others = [str(dim) for dim in values.dims if dim not in data[clock].dims]
        if others:
            names.append(f"{name} (over {', '.join(others)})")
        elif not _by_standard(standard) and not _by_name(path, str(name), standard):
            names.append(str(name))
    return names


def _clock(data: xr.Dataset) -> str | None:
    """The times at which values are valid, not those at which forecasts start."""
    there = [n for n in CLOCKS if n in data.variables and data[n].ndim == 1]
    there = [n for n in there if np.issubdtype(data[n].dtype, np.datetime64)]
    starts = [n for n in there if data[n].attrs.get("standard_name") == STARTS]
    return next((n for n in there if n not in starts), next(iter(there), None))


def _without_times(path: Path, data: xr.Dataset) -> InputError:
    """The error of a file without a clock: it has no times, one time, or times that are no dates."""
    times = next((data[name] for name in CLOCKS if name in data.variables), None)
    if times is None:
        found = "the file has no times"
        return InputError(path, "time", found, "add a coordinate 'time' as in the CF conventions")
    if times.ndim == 0:
        return InputError(path, "time", "the record has 1 row", "give two rows or more")
    found = "the times are numbers, not dates"
    if calendar := times.encoding.get("calendar"):
        found = f"the times are dates of the calendar {calendar!r}"
    allowed = "give dates of the standard calendar, with units such as 'hours since 2000-01-01'"
    return InputError(path, str(times.name), found, allowed)


def _columns(path: Path, data: xr.Dataset, clock: str) -> Iterator[tuple[Column, FloatArray, str]]:
    """Quantities in variables over time alone; quantities with CF standard names come first."""
    over = {str(n): v for n, v in data.data_vars.items() if v.dims == data[clock].dims}
    for by_standard in (True, False):
        for name, values in over.items():
            standard = str(values.attrs.get("standard_name", ""))
            one = _by_standard(standard) if by_standard else _by_name(path, name, standard)
            if one is None:
                continue
            unit = _written(str(values.attrs.get("units", "")))
            numbers = values.values.astype(float)
            if standard == PEAK_FREQUENCY or plain(name) == "fp":
                numbers, note = _periods(path, name, numbers, unit)
            elif one.unit == "deg":
                numbers, note = _from_where(path, name, numbers, unit, standard)
            else:
                of = head(str(path), f"{one.name} ({unit})")
                check_fills(path, numbers, of._replace(heading=name))
                note = f"{one.name} from {unit}" if of.factor != 1.0 else ""
                note = "; ".join(filter(None, (note, str(values.attrs.get("comment", "")))))
                numbers = numbers * of.factor
                if not by_standard and plain(name) == "wave_height":
                    note = "; ".join(filter(None, (note, UNSURE_HEIGHT)))
            yield one, numbers, note
    for name, every in PARTS.items():
        for east, north in every:
            if east in over and north in over:
                parts = []
                for part in (over[east], over[north]):
                    unit = _written(str(part.attrs.get("units", "")))
                    factor = head(str(path), f"{name} ({unit})").factor
                    parts.append(part.values.astype(float) * factor)
                yield NAMES[name], np.hypot(*parts), f"{name} from {east} and {north}"


def _by_standard(standard: str) -> Column | None:
    """The quantity of a CF standard name."""
    if standard == PEAK_FREQUENCY:
        return NAMES["peak_period"]
    if standard == GOES_TO:
        return NAMES["wave_from_direction"]
    return next((one for one in COLUMNS if one.standard_name == standard), None)


def _by_name(path: Path, name: str, standard: str) -> Column | None:
    """The quantity of a variable's name."""
    if standard.startswith("sea_surface_") or _by_standard(standard):
        return None  # the standard name is more precise, for instance for wind waves alone
    key = plain(name)
    if any(key in pair for pairs in PARTS.values() for pair in pairs):
        return None
    if key in UNSURE:
        allowed = f"give it the standard_name {COMES_FROM} or {GOES_TO}"
        found = "the file does not state whether waves come from this direction or travel towards it"
        raise InputError(path, name, found, allowed)
    if key == "fp":
        return NAMES["peak_period"]
    return NAMES.get(SOURCES.get(key, key))


def _periods(path: Path, name: str, numbers: FloatArray, unit: str) -> tuple[FloatArray, str]:
    """Periods, converted from frequencies if needed."""
    factors = {"hz": 1.0, "s-1": 1.0, "1/s": 1.0, "rad/s": 0.5 / np.pi, "rad s-1": 0.5 / np.pi}
    factor = factors.get(unit.lower())
    if factor is None:
        found = f"{unit!r} is not a unit of frequency"
        raise InputError(path, name, found, "give the unit Hz or rad/s")
    with np.errstate(divide="ignore"):  # a frequency of zero is a missing period
        periods = 1.0 / (factor * numbers)
    return np.where(np.isfinite(periods), periods, np.nan), f"peak_period from {name} ({unit})"


def _from_where(
    path: Path, name: str, numbers: FloatArray, unit: str, standard: str
) -> tuple[FloatArray, str]:
    """Bearings that waves come from, in degrees from 0 to 360."""
    factors = {"deg": 1.0, "rad": np.degrees(1.0), "radian": np.degrees(1.0)}
    if unit not in factors:
        found = f"{unit!r} is not a unit of direction"
        raise InputError(path, name, found, "give the unit degree or radian")
    turn = 180.0 if standard == GOES_TO else 0.0
    note = [f"from {unit}"] if unit != "deg" else []
    note += ["turned by 180 deg from the direction in which waves travel"] if turn else []
    degrees = numbers * factors[unit]
    # an invalid bearing is not changed, so the error can name its row
    bearings = np.where(np.abs(degrees) <= 360.0, (degrees + turn) % 360.0, degrees)
    return bearings, f"wave_from_direction {' and '.join(note)}" if note else ""


def _written(unit: str) -> str:
    """A CF unit, such as ``m s-1``, in the notation of this package."""
    text = unit.strip()
    if text.lower() in SPELT:
        return SPELT[text.lower()]
    return re.sub(r"\s+([a-z]+)-1\b", r"/\1", text.replace("**", "")).strip()


def _at_one_place(path: Path, data: xr.Dataset, near: Place | None) -> tuple[xr.Dataset, list[str]]:
    """The data at one place: the only one, or the nearest."""
    data = data.squeeze(drop=False)
    lat, lon = (
        next((n for n in names if n in data.variables), "")
        for names in (("latitude", "lat"), ("longitude", "lon"))
    )
    dims = {d for n in (lat, lon) if n for d in data[n].dims if d not in CLOCKS}
    if not dims and near is None:
        return data, []
    if not (lat and lon):
        raise InputError(path, "--near", "the file has no latitudes and longitudes", "omit --near")
    if near is None:
        many = ", ".join(f"{data.sizes[d]} of {d}" for d in sorted(map(str, dims)))
        why = f"the file covers several places ({many})"
        allowed = "select a place with `riserstudy seas --near 'LAT, LON'`"
        raise InputError(path, "latitude, longitude", why, allowed)
    latitude, longitude = _places(data, lat, lon)
    north = np.radians(latitude.values - near.latitude)
    east = np.radians((longitude.values - near.longitude + 180.0) % 360.0 - 180.0)
    away = np.hypot(north, east * np.cos(np.radians(near.latitude)))
    at = np.unravel_index(int(np.nanargmin(away)), away.shape)
    place = dict(zip(map(str, latitude.dims), map(int, at), strict=True))
    found = latitude.isel(place).item(), longitude.isel(place).item()
    far = float(np.degrees(away[at])) * EARTH
    note = f"read at {found[0]:.4g} N, {found[1]:.4g} E, {far:.0f} km from the given place"
    return data.isel(place), [note]


def _places(data: xr.Dataset, lat: str, lon: str) -> tuple[xr.DataArray, xr.DataArray]:
    """Latitude and longitude of all places, without the dimension time."""
    import xarray as xr

    parts = [data[name] for name in (lat, lon)]
    parts = [v.isel({d: 0 for d in v.dims if d in CLOCKS}) for v in parts]
    latitude, longitude = xr.broadcast(*parts)
    return latitude, longitude


def _spectra(data: xr.Dataset) -> str:
    """Name of the variable with spectra; "" if there is none."""
    names = ("efth", "d2fd", "spectral_wave_density", "density")
    return next((n for n in names if n in data.data_vars and data[n].ndim >= 2), "")


def _of_spectra(path: Path, data: xr.Dataset, name: str) -> tuple[xr.Dataset, str]:
    """Heights, periods and directions of spectra, by wavespectra."""
    from wavespectra.input.dataset import read_dataset

    try:
        spectra = read_dataset(data)
        found = {"hs": spectra.spec.hs(), "tp": spectra.spec.tp(), "tm02": spectra.spec.tm02()}
        directed = "dir" in spectra.efth.dims
        if directed:
            found["mwd"] = spectra.spec.dm()
    except (ValueError, KeyError, AttributeError) as error:
        why = f"the spectra cannot be read: {error}"
        allowed = "give spectra in the format of ERA5, WAVEWATCH III, NDBC, SWAN or wavespectra"
        raise InputError(path, name, why, allowed) from None
    units = {"hs": "m", "tp": "s", "tm02": "s", "mwd": "deg"}
    made = {n: v.squeeze(drop=True).drop_attrs().assign_attrs(units=units[n]) for n, v in found.items()}
    import xarray as xr

    whole = "with" if directed else "without"
    return xr.Dataset(made), f"from spectra {whole} directions, by wavespectra"
