"""A record of sea states: read from CSV or netCDF, checked row by row, gaps reported and never filled."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from functools import reduce
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.netcdf import write_netcdf
from riserstudy.errors import InputError
from riserstudy.inputs.text import read_text
from riserstudy.scene.units import to_si
from riserstudy.seas.columns import COLUMNS, UNSURE_HEIGHT, Head, check_fills, head, labels_of
from riserstudy.seas.netcdf_record import CONVERTED, Place, read_netcdf
from riserstudy.seas.zones import check_zone_of_table
from riserstudy.study.spacing import FURTHER, check_spacing

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

LARGEST_FILE = 500 * 10**6  # largest size of a file, in bytes
MISSING = ("", "nan", "na", "n/a", "null")
#: fill values of NDBC and others; a bearing of 99.0 deg or a height of 99.0 cm is a value
FILLS = ("-999", "-999.0", "999", "9999", "99.0", "99.00")
CLOSER = 0.95  # distance of rows, in intervals, below which they count as too close
MOST_CLOSER = 0.01  # largest share of such rows, since clocks are adjusted occasionally
SHORTEST_DATE = len("20051231")
ZONES = ("", "utc", "gmt", "z", "iso 8601", "iso8601")  # texts in a header for times in UTC
#: coefficients of gamma to the powers 0 to 3: zero-upcrossing period / peak period of a JONSWAP spectrum
PERIODS = (0.6673, 0.05037, -0.006230, 0.0003341)
PATTERNS = (("YYYY", "%Y"), ("MM", "%m"), ("DD", "%d"), ("hh", "%H"), ("HH", "%H"), ("mm", "%M"))


class Gap(NamedTuple):
    """A gap in a record: the last time before it, and the first time after it."""

    before: np.datetime64
    after: np.datetime64


def read_record(path: Path, near: Place | None = None) -> xr.Dataset:
    """A record of sea states.

    Raises InputError with the file, the row and the column of the first fault.

    Parameters
    ----------
    path : Path
        CSV with a header such as ``time,hs (m),tp (s)``, times in UTC; or netCDF
        (`riserstudy.seas.netcdf_record`).
    near : Place, optional
        Place; the nearest place of a netCDF file with several places is read.

    Returns
    -------
    xarray.Dataset
        Over ``time``: the quantities of `riserstudy.seas.columns` in the file, in SI units, NaN for missing
        values. The attribute ``interval_hours`` is the most frequent time between rows with a height.
    """
    import xarray as xr

    if near is not None and path.suffix != ".nc":
        raise InputError(path, "--near", "has no effect on a table, which is for one place", "omit it")
    frame, notes = read_netcdf(path, near) if path.suffix == ".nc" else _from_csv(path)
    if "significant_wave_height" not in frame:
        allowed = "add a column such as 'significant_wave_height (m)'"
        raise InputError(path, "significant_wave_height", "this column is missing", allowed)
    _check(path, frame)
    record = xr.Dataset.from_dataframe(frame)
    for one in COLUMNS:
        if one.name in record:
            record[one.name].attrs = labels_of(one)
    if CONVERTED in frame.attrs:
        record["peak_period"].attrs[CONVERTED] = frame.attrs[CONVERTED]
    record["time"].attrs = {"long_name": "time, UTC", "standard_name": "time"}
    record.attrs = {
        "Conventions": "CF-1.11",
        "title": f"sea states of {path.name}",
        "interval_hours": interval_of_rows(
            frame.index.to_numpy()[frame["significant_wave_height"].notna()],
            interval_hours(frame.index.to_numpy()),
        ),
        "conversions": notes,
    }
    return record


def write_record(record: xr.Dataset, target: Path) -> None:
    """Write a record as CF netCDF, completely or not at all.

    Raises SimulationError when it cannot be written, as on a full disk.
    """
    encoding: dict[str, dict[str, Any]] = {
        str(name): {"zlib": True, "complevel": 3} for name in record.data_vars
    }
    encoding["time"] = {"units": "seconds since 1970-01-01", "dtype": "float64"}
    write_netcdf(record, target, encoding)


def interval_hours(time: NDArray[np.datetime64]) -> float:
    """The most frequent time between rows (h)."""
    steps, counts = np.unique(np.diff(time), return_counts=True)
    return float(steps[counts.argmax()] / np.timedelta64(1, "s")) / 3600.0


def interval_of_rows(time: NDArray[np.datetime64], otherwise: float) -> float:
    """The time between most of some rows (h), such as the rows with a height among rows with a wind speed.

    ``otherwise``: interval of all rows (h), the result if no time is between more than half of the rows.
    """
    steps, counts = np.unique(np.diff(time), return_counts=True)
    return interval_hours(time) if len(steps) and counts.max() > 0.5 * counts.sum() else otherwise


def gaps(record: xr.Dataset) -> list[Gap]:
    """Gaps: rows whose distance exceeds the most frequent interval by more than clock errors."""
    time = record["time"].values
    wide = np.flatnonzero(_intervals(time, record.attrs["interval_hours"]) > FURTHER)
    return [Gap(time[k], time[k + 1]) for k in wide]


def next_to_each_other(time: NDArray[np.datetime64], interval: float) -> NDArray[np.bool_]:
    """Whether no gap is between each row (n,) and the next, (n - 1,); most are one interval (h) apart.

    Rows that are closer, because a clock was set, have no gap between them.
    """
    return np.asarray(_intervals(time, interval) <= FURTHER)


def _intervals(time: NDArray[np.datetime64], interval: float) -> NDArray[np.float64]:
    """Times between rows, in intervals (h)."""
    return np.asarray(np.diff(time) / np.timedelta64(1, "s") / 3600.0 / interval)


def check_windows(record: xr.Dataset, windows: Sequence[str]) -> None:
    """Check that lengths of work, such as ``24 h``, are whole numbers of the record's intervals.

    Raises InputError if one is not.
    """
    for text in windows:
        rows_of(to_si(text, "s") / 3600.0, float(record.attrs["interval_hours"]))


def rows_of(hours: float, interval: float) -> int:
    """Number of rows of a record (interval: hours between rows) in a length of work (h).

    Raises InputError when this is not a whole number.
    """
    rows = hours / interval
    if rows < 1.0 or abs(rows - round(rows)) > 1e-6:
        found = f"the window is not a multiple of the interval of the record, {interval:g} h"
        raise InputError("--window", f"{hours:g} h", found, "give a multiple of this interval")
    return round(rows)


def with_peak_period(record: xr.Dataset, gamma: float) -> xr.Dataset:
    """The record with a peak period, from the zero-upcrossing period if it has no peak period.

    References
    ----------
    DNV-RP-C205, 3.5.5: T_z / T_p of a JONSWAP spectrum as a polynomial of its peakedness gamma.
    """
    if "peak_period" in record or "zero_crossing_period" not in record:
        return record
    ratio = sum(factor * gamma**power for power, factor in enumerate(PERIODS))
    period = record["zero_crossing_period"] / ratio
    period.attrs = {
        "units": "s",
        "long_name": "peak period",
        "comment": f"zero-upcrossing period over {ratio:.4f}, JONSWAP with gamma {gamma:g}",
        CONVERTED: gamma,
    }
    return record.assign(peak_period=period)


def _from_csv(path: Path) -> tuple[pd.DataFrame, str]:
    """Known columns by time, with notes on conversions."""
    import pandas as pd

    text = read_text(path, LARGEST_FILE)
    first = (text.splitlines() or [""])[0]
    separator = max(";,\t", key=first.count)
    _check_head(path, text, separator)
    try:
        cells = pd.read_csv(
            io.StringIO(text), sep=separator, dtype=str, keep_default_na=False, skipinitialspace=True
        )
    except pd.errors.EmptyDataError:
        found = "the file is empty"
        raise InputError(path, "", found, "give a header and a line for each time") from None
    except pd.errors.ParserError as error:
        found = str(error).strip().rpartition(": ")[2] or str(error)
        raise InputError(path, "", found, "write one cell for each column in every line") from None
    heads = [head(str(path), str(name)) for name in cells.columns]
    if {"u10", "v10"} <= {one.heading for one in heads}:
        found = "these are the components of the wind towards east and north"
        allowed = "compute their magnitude and give it as wind_speed"
        raise InputError(path, "u10, v10", found, allowed)
    at = next((k for k, one in enumerate(heads) if one.heading == "time"), None)
    if at is None:
        raise InputError(path, "time", "this column is missing", "add a column 'time', in UTC")
    columns = {"time": _times(path, cells.iloc[:, at], heads[at].unit)}
    for k, one in enumerate(heads):
        if one.quantity is None:
            check_zone_of_table(path, one.heading, cells.iloc[:, k])
            continue
        if one.quantity.name in columns:
            found = "two columns give this quantity"
            raise InputError(path, one.quantity.name, found, "remove one of them")
        columns[one.quantity.name] = _numbers(path, cells.iloc[:, k], one)
    left = [str(cells.columns[k]) for k, one in enumerate(heads) if one.quantity is None and k != at]
    notes = [f"{one.quantity.name} from {one.unit}" for one in heads if one.quantity and one.factor != 1.0]
    notes += [f"wave_from_direction turned by 180 deg from {one.heading}" for one in heads if one.turned]
    notes += [note for k, one in enumerate(heads) if (note := _fills(cells.iloc[:, k], one))]
    notes += [UNSURE_HEIGHT for one in heads if one.quantity and one.heading == "wave_height"]
    notes += [f"left out: {', '.join(left)}"] if left else []
    return pd.DataFrame(columns).set_index("time"), "; ".join(notes)


def _check_head(path: Path, text: str, separator: str) -> None:
    """Check that no heading occurs twice, and that the first row has no more cells than the header.

    Raises InputError otherwise, because columns would be lost or shifted.
    """
    lines = io.StringIO(text, newline=None)  # also ends lines at "\r" alone
    rows = list(islice(csv.reader(lines, delimiter=separator), 2))
    heads = [cell.strip() for cell in rows[0]] if rows else []
    if twice := next((cell for cell in heads if heads.count(cell) > 1), ""):
        raise InputError(path, twice, "two columns have this heading", "remove one of them")
    if len(rows) > 1 and len(rows[1]) > len(heads):
        found = f"the row has {len(rows[1])} cells, but the header {len(heads)} columns"
        raise InputError(f"{path}, row 2", "", found, "write one cell for each column")


def _check_clock(path: Path, pattern: str) -> None:
    """Check that the header of times has a pattern, or states UTC.

    Raises InputError if it states another zone, or a unit such as hours.
    """
    words = re.findall(r"[A-Za-z]+", reduce(lambda rest, one: rest.replace(one[0], ""), PATTERNS, pattern))
    known = all(word.lower() in ("t", *ZONES) for word in words)
    if not (known if "YYYY" in pattern else pattern.strip().lower() in ZONES):
        allowed = "write 'time (UTC)', or a pattern such as 'time (YYYY-MM-DD-HH)'"
        found = f"{pattern!r} is neither UTC nor a pattern of dates"
        raise InputError(path, f"time ({pattern})", found, allowed)


def _times(path: Path, cells: pd.Series, pattern: str) -> pd.Series:
    import pandas as pd

    _check_clock(path, pattern)
    form = pattern
    for word, code in PATTERNS:
        form = form.replace(word, code, 1)
    known = "%Y" in form
    times = pd.to_datetime(
        cells.str.strip(), format=form if known else "ISO8601", errors="coerce", utc=True
    ).dt.tz_localize(None)
    bad = times.isna() | (cells.str.strip().str.len() < (0 if known else SHORTEST_DATE))
    if bad.any():
        row = int(bad.to_numpy().argmax())
        allowed = "write times such as 2005-12-31 23:00, or a header such as 'time (YYYY-MM-DD-HH)'"
        found = f"{cells.iloc[row]!r} is not a time"
        raise InputError(f"{path}, row {row + 2}", "time", found, allowed)
    return times


def _numbers(path: Path, cells: pd.Series, one: Head) -> pd.Series:
    import pandas as pd

    texts = cells.str.strip()
    absent = texts.str.lower().isin(MISSING)
    values = pd.to_numeric(texts.where(~absent), errors="coerce")
    absent |= texts.isin(FILLS) & ~_possible(values, one)
    values = values.where(~absent)
    bad = values.isna() & ~absent
    if bad.any():
        row = int(bad.to_numpy().argmax())
        found = f"{cells.iloc[row]!r} is not a number"
        allowed = "write a number, or leave the cell empty"
        raise InputError(f"{path}, row {row + 2}", one.heading, found, allowed)
    check_fills(path, values.to_numpy(), one)
    numbers = values.astype(float) * one.factor
    # an invalid bearing is not changed, so the error can name its row
    return numbers.where(~numbers.between(0.0, 360.0), (numbers + 180.0) % 360.0) if one.turned else numbers


def _possible(values: pd.Series, one: Head) -> pd.Series:
    """Whether fill values of others can be values: bearings, or numbers in a unit that is not SI."""
    if one.quantity is None or (one.quantity.unit != "deg" and one.factor == 1.0):
        return values.map(lambda _: False).astype(bool)
    return (values * one.factor).between(one.quantity.least, one.quantity.most)


def _fills(cells: pd.Series, one: Head) -> str:
    """A note on numbers that are fill values elsewhere, but count as values here; "" if there are none."""
    import pandas as pd

    texts = cells.str.strip()
    some = texts.isin(FILLS)
    if one.quantity is None or one.quantity.unit == "deg" or not some.any():
        return ""
    count = int(_possible(pd.to_numeric(texts[some]), one).sum())
    fills = ", ".join(sorted(set(texts[some])))
    return f"{count} cells of {one.heading} with {fills} {one.unit} are values" if count else ""


def _check_interval(path: Path, time: NDArray[np.datetime64], rows: NDArray[np.bool_]) -> None:
    """Check that few rows are closer than the usual interval, because each row counts as one interval.

    ``time``, ``rows``: (n,) times, and whether a row is compared. Raises InputError if many are closer, as in
    a record that becomes hourly.
    """
    if rows.sum() < 2:
        return
    usual = interval_hours(time[rows])
    steps = np.diff(time[rows]) / np.timedelta64(1, "s") / 3600.0
    closer = steps < CLOSER * usual
    if closer.mean() > MOST_CLOSER:
        row = int(closer.argmax())
        found = f"this row is {steps[row]:g} h after the previous row, but most rows are {usual:g} h apart"
        raise InputError(
            f"{path}, row {int(np.flatnonzero(rows)[row + 1]) + 2}",
            "time",
            found,
            "keep only rows that are at least one interval apart",
        )


def _check(path: Path, frame: pd.DataFrame) -> None:
    """Check that times increase, and that every number is possible.

    Raises InputError at the first row with a fault.
    """
    if len(frame) < 2:
        found = f"the record has {len(frame)} row{'s' * (len(frame) != 1)}"
        raise InputError(path, "time", found, "give two rows or more")
    steps = np.diff(frame.index.to_numpy()).astype("timedelta64[s]").astype(float)
    if (steps <= 0.0).any():
        row = int((steps <= 0.0).argmax()) + 3
        found = "the time is not after the time of the previous row"
        raise InputError(f"{path}, row {row}", "time", found, "sort the rows by time")
    time, there = frame.index.to_numpy(), np.isfinite(frame["significant_wave_height"].to_numpy())
    for rows in (np.ones(len(time), bool), there):
        _check_interval(path, time, rows)
    check_spacing(path, time[there])
    both = [frame[n].to_numpy() for n in ("peak_period", "zero_crossing_period") if n in frame]
    if len(both) == 2 and np.nanmedian(both[0] / both[1]) < 1.0:
        found = "in most rows it is shorter than the zero-crossing period"
        raise InputError(path, "peak_period", found, "check whether the two columns are exchanged")
    for one in COLUMNS:
        if one.name not in frame:
            continue
        values = frame[one.name].to_numpy()
        wrong = (values < one.least) | (values > one.most)
        if wrong.any():
            row = int(wrong.argmax())
            raise InputError(
                f"{path}, row {row + 2}",
                one.name,
                f"{values[row]:g} {one.unit} is impossible",
                f"give {one.least:g} to {one.most:g} {one.unit}, or an empty cell",
            )
