"""Hours of years kept back, from those before: `python workflow/scripts/predict_years.py RECORD [--open]`.

Without --open rows of the kept years are dropped before anything is computed, and predictions are written;
with it the sealed ones are compared with what came. The record is the netCDF of `riserstudy seas`.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import numpy as np
import xarray as xr

from riserstudy.seas.hours import Hours, hours, sea_limit
from riserstudy.seas.record import read_record

FOLDER = Path(__file__).resolve().parents[2] / "config/predictions"
SEALED, OPENED = FOLDER / "kept_back_years.csv", FOLDER / "kept_back_years_opened.csv"
FIRST, AHEAD = 2001, 5  # the first year that is kept back, and how many are
LIMITS = ("hs <= 0.5 m", "hs <= 1 m", "hs <= 1.5 m", "hs <= 2 m", "hs <= 3 m")
COLUMNS = ("limit", "years", "share", "low", "high")


def main() -> None:
    """Predict, or open."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("record", type=Path)
    parser.add_argument("--open", action="store_true")
    options = parser.parse_args()
    record = read_record(options.record)
    year = record["time"].values.astype("datetime64[Y]").astype(int) + 1970
    if options.open:
        write(OPENED, (*COLUMNS, "came", "inside"), opened(record, year))
        return
    before = record.isel(time=np.flatnonzero(year < FIRST))
    write(SEALED, COLUMNS, predicted(before))


def predicted(before: xr.Dataset) -> list[list[str]]:
    """Share of workable hours of one year and of all years kept back, with nine in ten of draws."""
    rows = []
    for limit in LIMITS:
        known = hours(before, [sea_limit(limit)])
        for years in (1, AHEAD):
            band = known.next_years(years)
            rows.append([limit, str(years), *(f"{value:.4f}" for value in band)])
    return rows


def opened(record: xr.Dataset, year: np.ndarray) -> list[list[str]]:
    """The sealed rows with what came: of each year, and of all together."""
    with SEALED.open(encoding="utf-8", newline="") as file:
        sealed = list(csv.reader(file))[1:]
    rows = []
    for limit, years, *band in sealed:
        came = hours(record.isel(time=np.flatnonzero(year >= FIRST)), [sea_limit(limit)])
        for value in shares(came, int(years)):
            inside = float(band[1]) <= value <= float(band[2])
            rows.append([limit, years, *band, f"{value:.4f}", "yes" if inside else "no"])
    return rows


def shares(came: Hours, years: int) -> list[float]:
    """Shares that came: of all years, or of each that is recorded nearly whole."""
    return [came.share] if years > 1 else [year.share for year in came.years]


def write(target: Path, head: tuple[str, ...], rows: list[list[str]]) -> None:
    """Write a table."""
    with target.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows])
    print(target)


if __name__ == "__main__":
    main()
