"""Content of records of sea states."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from riserstudy.cli.shared import ReturnOption, check_targets, show, wrote
from riserstudy.cli.targets import ForceOption, Writes
from riserstudy.errors import InputError
from riserstudy.records.words import counted

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr

    from riserstudy.dataset.table import Table
    from riserstudy.seas.netcdf_record import Place


USUAL_GAMMA = 3.3

RecordArgument = Annotated[
    Path | None, typer.Argument(help="record of sea states: CSV or netCDF", metavar="RECORD.csv")
]
SyntheticOption = Annotated[
    int | None,
    typer.Option(
        min=1, max=100, help="make a synthetic record of this number of years, instead of reading one"
    ),
]
GammaOption = Annotated[
    float | None,
    typer.Option(
        min=1.0,
        max=7.0,
        help="peak enhancement (JONSWAP gamma) with which zero-crossing periods are converted to peak "
        "periods; default: 3.3",
    ),
]
NearOption = Annotated[
    str | None,
    typer.Option(
        help="in a netCDF file with several locations, use the location nearest to this position",
        metavar="'LAT, LON'",
    ),
]
ContourOption = Annotated[
    int | None,
    typer.Option(
        min=1,
        max=10000,
        help="return period, in years, of a contour (curve of extremes) of wave height and "
        "period; requires the package virocon",
        metavar="YEARS",
    ),
]
ContourCsvOption = Annotated[
    Path | None,
    typer.Option("--csv", help="with --contour: write the contour to this file", metavar="OUT.csv"),
    Writes("table"),
]
OutputOption = Annotated[
    Path | None,
    typer.Option("-o", "--output", help="write the record to this file (netCDF)", metavar="OUT.nc"),
    Writes("dataset"),
]


def seas(
    record: RecordArgument = None,
    synthetic: SyntheticOption = None,
    seed: Annotated[
        int | None, typer.Option(min=0, help="seed (start value) of the random synthetic record; default: 1")
    ] = None,
    gamma: GammaOption = None,
    near: NearOption = None,
    period: ReturnOption = None,
    contour: ContourOption = None,
    csv: ContourCsvOption = None,
    output: OutputOption = None,
    force: ForceOption = False,
) -> None:
    """Read a record of sea states, summarise it, and write it as a netCDF dataset.

    The command ``seas`` lists gaps in the record and never fills them. A record in a CSV file has a
    header such as ``time,hs (m),tp (s)``; its times are in UTC.
    """
    if (record is None) == (synthetic is None):
        why = "missing" if record is None else "given together with --synthetic"
        raise InputError("RECORD", "", why, "give either the file of a record, or --synthetic")
    check_targets([record] if record else [], force, csv, output=output)
    if csv is not None and not contour:
        why = f"{csv} has no effect without --contour"
        raise InputError("seas", "--csv", why, "add --contour, or omit --csv")
    from riserstudy.seas import contours
    from riserstudy.seas.record import read_record, with_peak_period, write_record
    from riserstudy.seas.synthetic import synthetic as made

    if record is None and near is not None:
        why = f"{near!r} has no effect on a synthetic record"
        raise InputError("seas", "--near", why, "omit --near, or give the file of a record")
    if record is not None and seed is not None:
        why = f"{seed} has no effect on the file of a record"
        raise InputError("seas", "--seed", why, "omit --seed, or give --synthetic")
    place = _place(near) if near else None
    found = (
        made(synthetic or 1, 1 if seed is None else seed) if record is None else read_record(record, place)
    )
    check_gamma("seas", gamma, found)
    found = with_peak_period(found, gamma or USUAL_GAMMA)
    # both may refuse the record, before anything is printed
    heights = return_heights(found, period) if period else None
    places = contours.contour(found, contour) if contour else None
    for line in described(found):
        print(line)
    if heights:
        print("heights that are exceeded in a year with a probability of 1 / return period:")
        show(heights, None)
    if places:
        show(places, csv)
        for line in contours.doubts(found, places):
            print(line)
    if output is not None:
        write_record(found, output)
        wrote(output)


def check_gamma(command: str, gamma: float | None, record: xr.Dataset) -> None:
    """Check that a gamma (1), if given, is needed to convert periods of a record.

    Raises InputError if it would have no effect.
    """
    if gamma is None or ("peak_period" not in record and "zero_crossing_period" in record):
        return
    found = "the record has peak periods" if "peak_period" in record else "the record has no periods"
    raise InputError(command, "--gamma", f"{gamma:g} has no effect, since {found}", "omit --gamma")


def _place(text: str) -> Place:
    """A place from a text such as ``60.5, 2.3``: degrees north and east."""
    from riserstudy.seas.netcdf_record import Place

    try:
        latitude, longitude = (float(part) for part in text.split(","))
    except ValueError:
        latitude, longitude = math.nan, math.nan
    if not (abs(latitude) <= 90.0 and abs(longitude) <= 360.0):
        found = f"{text!r} is not a latitude and a longitude"
        raise InputError("seas", "--near", found, "give degrees north and east, such as '60.5, 2.3'")
    return Place(latitude, longitude)


def return_heights(record: xr.Dataset, periods: list[int]) -> Table:
    """Return values of the significant wave height, for return periods in years."""
    from riserstudy.seas.return_values import return_values

    height = record["significant_wave_height"].values
    interval = float(record.attrs["interval_hours"])
    return return_values(record["time"].values, height, interval, periods, "m")


def described(record: xr.Dataset) -> list[str]:
    """A summary of a record, as lines of text."""
    import numpy as np

    from riserstudy.seas.record import gaps, interval_hours
    from riserstudy.study.months import uneven_months

    time = record["time"].values
    holes = gaps(record)
    missing = sum((g.after - g.before) / np.timedelta64(1, "h") for g in holes)
    missing -= len(holes) * record.attrs["interval_hours"]
    span = (time[-1] - time[0]) / np.timedelta64(1, "h") + record.attrs["interval_hours"]
    each, of_heights = interval_hours(time), record.attrs["interval_hours"]
    first, last = (str(t.astype("datetime64[m]")).replace("T", " ") for t in (time[0], time[-1]))
    lines = [
        f"{first} to {last} UTC: {counted(len(time), 'row')}, "
        f"most {each:g} h apart" + (f", heights {of_heights:g} h apart" if of_heights != each else ""),
        f"gaps: {len(holes)}, {missing:g} h together, {missing / span:.1%} of the time",
    ]
    widest = sorted(holes, key=lambda g: g.before - g.after)[:3]
    for gap in widest:
        ends = (str(t.astype("datetime64[m]")).replace("T", " ") for t in gap)
        lines.append(f"  {(gap.after - gap.before) / np.timedelta64(1, 'h'):g} h: {' to '.join(ends)}")
    if note := uneven_months(time):
        lines.append(note)
    if record.attrs["conversions"]:
        lines.append(f"converted: {record.attrs['conversions']}")
    lines.append(f"{'':28}    mean    99 %  largest  missing")
    for name, values in record.data_vars.items():
        known = values.values[np.isfinite(values.values)]
        if values.attrs.get("units") == "degree":
            numbers = f"{_mean_direction(known):>8}{'-':>8}{'-':>9}"
        elif len(known):
            numbers = f"{known.mean():8.5g}{np.quantile(known, 0.99):8.5g}{known.max():9.5g}"
        else:
            numbers = f"{'':25}"
        about = f"{name} ({values.attrs.get('units', '')})"
        lines.append(f"{about:28}{numbers}{len(values) - len(known):9d}")
        if "comment" in values.attrs:
            lines.append(f"  {values.attrs['comment']}")
    return lines


def _mean_direction(bearings: np.ndarray) -> str:
    """The direction of the sum of unit vectors, as text; a dash if they cancel. ``bearings``: degrees."""
    import cmath

    import numpy as np

    total = complex(np.exp(1j * np.radians(bearings)).sum())
    if abs(total) <= 1e-6 * len(bearings):
        return "-"
    return f"{round(float(np.degrees(cmath.phase(total))), 1) % 360.0:.1f}"
