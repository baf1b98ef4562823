"""Predict the workable hours of withheld years from the years before them.

Use: `python workflow/scripts/predict_years.py RECORD [--open]`. Without --open, rows after the last known
year are removed before any computation, and predictions are written. With --open, the sealed predictions
are compared with the hours that occurred.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import numpy as np
import xarray as xr

from riserstudy.seas.hours import hours, sea_limit
from riserstudy.seas.record import read_record

FOLDER = Path(__file__).resolve().parents[2] / "config/predictions"
SEALED, OPENED = FOLDER / "hindcast_years.csv", FOLDER / "hindcast_years_opened.csv"
FIRST, KNOWN, AHEAD = (1965, (3, 5, 10), (1, 5, 10))  # first year, numbers of known and of withheld years
LIMITS = (
    *("hs <= 1 m", "hs <= 1.5 m", "hs <= 2 m", "hs <= 3 m", "hs <= 4 m"),
    *("wind_speed <= 8 m/s", "wind_speed <= 12 m/s", "wind_speed <= 16 m/s"),
)
COLUMNS = ("limit", "known", "years", "share", "low", "high")


def main() -> None:
    """Write predictions, or compare the sealed predictions with the record."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("record", type=Path)
    parser.add_argument("--open", action="store_true")
    options = parser.parse_args()
    record = read_record(options.record)
    if options.open:
        write(OPENED, (*COLUMNS, "observed", "inside"), opened(record))
        return
    write(SEALED, COLUMNS, predicted(of_years(record, FIRST, FIRST + max(KNOWN))))


def of_years(record: xr.Dataset, first: int, end: int) -> xr.Dataset:
    """Return the rows of the years from ``first`` to ``end``, without ``end``."""
    year = record["time"].values.astype("datetime64[Y]").astype(int) + 1970
    return record.isel(time=np.flatnonzero((year >= first) & (year < end)))


def predicted(record: xr.Dataset) -> list[list[str]]:
    """Predict the share of workable hours of withheld years, with a 90 % band, from the known years."""
    rows = []
    for limit in LIMITS:
        for known in KNOWN:
            before = hours(of_years(record, FIRST, FIRST + known), [sea_limit(limit)])
            for years in AHEAD:
                band = before.next_years(years)
                rows.append([limit, str(known), str(years), *(f"{value:.4f}" for value in band)])
    return rows


def opened(record: xr.Dataset) -> list[list[str]]:
    """Return the sealed rows, each with the share that occurred and whether it is inside the band."""
    with SEALED.open(encoding="utf-8", newline="") as file:
        sealed = list(csv.reader(file))[1:]
    rows = []
    for limit, known, years, *band in sealed:
        first = FIRST + int(known)
        observed = hours(of_years(record, first, first + int(years)), [sea_limit(limit)]).share
        inside = float(band[1]) <= observed <= float(band[2])
        rows.append([limit, known, years, *band, f"{observed:.4f}", "yes" if inside else "no"])
    return rows


def write(target: Path, head: tuple[str, ...], rows: list[list[str]]) -> None:
    """Write a table as CSV, and print its path."""
    with target.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows])
    print(target)


if __name__ == "__main__":
    main()
