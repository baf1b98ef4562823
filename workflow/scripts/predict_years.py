"""Hours of years kept back, from those before: `python workflow/scripts/predict_years.py RECORD [--open]`.

Without --open rows after the last known year are dropped before anything is computed, and predictions are
written; with it the sealed ones are compared with what came.
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
FIRST, KNOWN, AHEAD = (
    1965,
    (3, 5, 10),
    (1, 5, 10),
)  # first year, and how many are known and kept back
LIMITS = (
    *("hs <= 1 m", "hs <= 1.5 m", "hs <= 2 m", "hs <= 3 m", "hs <= 4 m"),
    *("wind_speed <= 8 m/s", "wind_speed <= 12 m/s", "wind_speed <= 16 m/s"),
)
COLUMNS = ("limit", "known", "years", "share", "low", "high")


def main() -> None:
    """Predict, or open."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("record", type=Path)
    parser.add_argument("--open", action="store_true")
    options = parser.parse_args()
    record = read_record(options.record)
    if options.open:
        write(OPENED, (*COLUMNS, "came", "inside"), opened(record))
        return
    write(SEALED, COLUMNS, predicted(of_years(record, FIRST, FIRST + max(KNOWN))))


def of_years(record: xr.Dataset, first: int, end: int) -> xr.Dataset:
    """Rows of some years; those of the last one are left out."""
    year = record["time"].values.astype("datetime64[Y]").astype(int) + 1970
    return record.isel(time=np.flatnonzero((year >= first) & (year < end)))


def predicted(record: xr.Dataset) -> list[list[str]]:
    """Share of workable hours of years kept back, with the band of nine in ten, from so many before them."""
    rows = []
    for limit in LIMITS:
        for known in KNOWN:
            before = hours(of_years(record, FIRST, FIRST + known), [sea_limit(limit)])
            for years in AHEAD:
                band = before.next_years(years)
                rows.append([limit, str(known), str(years), *(f"{value:.4f}" for value in band)])
    return rows


def opened(record: xr.Dataset) -> list[list[str]]:
    """The sealed rows with what came."""
    with SEALED.open(encoding="utf-8", newline="") as file:
        sealed = list(csv.reader(file))[1:]
    rows = []
    for limit, known, years, *band in sealed:
        first = FIRST + int(known)
        came = hours(of_years(record, first, first + int(years)), [sea_limit(limit)]).share
        inside = float(band[1]) <= came <= float(band[2])
        rows.append([limit, known, years, *band, f"{came:.4f}", "yes" if inside else "no"])
    return rows


def write(target: Path, head: tuple[str, ...], rows: list[list[str]]) -> None:
    """Write a table."""
    with target.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows])
    print(target)


if __name__ == "__main__":
    main()
