"""Workable hours as lines of text: bands, windows, waits, and a check by held-back years."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from riserstudy.cli.shared import show
from riserstudy.dataset.unit_systems import UnitSystem
from riserstudy.errors import InputError
from riserstudy.records.words import counted
from riserstudy.study.persistence import PERSISTENCES

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.seas.hours import Hours, SeaLimit
    from riserstudy.seas.riser_downtime import Downtime
    from riserstudy.seas.year_bands import Band


class Ahead(NamedTuple):
    """Number of future years, and persistence from year to year."""

    years: int
    persistence: float


def show_riser(
    made: Downtime, lengths: list[float], ahead: Ahead, csv: Path | None, units: UnitSystem
) -> None:
    """Print workable hours by mode, and the table of limits."""
    from riserstudy.dataset.tables import in_units

    for line in made.lines:
        print(line)
    for one in made.hours.modes:
        print(f"{one.mode}: {one.hours.share:.2%} of {counted(one.hours.rows, 'row')}")
        for line in waiting(one.hours):
            print(f"  {line}")
        print(f"  {one.low:.2%} to {one.high:.2%} because of the error of the response")
        print(f"  {banded(one.hours.mean_year(ahead.persistence))} in a mean year")
        show_hours(one.hours, lengths, ahead, "  ")
    show(in_units(made.hours.limits, units), csv)


def show_hours(found: Hours, lengths: list[float], ahead: Ahead, indent: str = "") -> None:
    """Print future years, the effect of persistence, excluded years, windows and waits."""
    print(f"{indent}next {counted(ahead.years, 'year')}: {banded(found.next_years(*ahead))}")
    others = [(h, found.next_years(ahead.years, h)) for h in PERSISTENCES]
    if not math.isnan(others[0][1].low):
        each = "; ".join(f"{of.low:.2%} to {of.high:.2%} at {h:g}" for h, of in others)
        print(f"{indent}  for a persistence of years {ahead.persistence:g}; {each}")
    for year in found.partial_years:
        print(f"{indent}{year.year}: {year.recorded:.0%} recorded, excluded from these bands")
    for length in lengths:
        of = found.of_windows(length)
        print(
            f"{indent}{length:g} h: {counted(of.number, 'window')} with {_share(of.inside)} of the hours; "
            f"a window can start in {_share(of.starts)}"
        )
        print(f"{indent}  wait (h)   mean    50 %    90 %   open")
        for name, one in found.of_waits(length):
            mean = "–" if math.isnan(one.mean) else f"{one.mean:.1f}"
            p50, p90 = ("–" if math.isnan(p) else f"{p:.1f}".removesuffix(".0") for p in (one.p50, one.p90))
            print(f"{indent}  {name:8} {mean:>6}  {p50:>6}  {p90:>6}  {one.open:5d}")


def show_directions(found: Hours, record: xr.Dataset, sectors: int | None, of: str = "") -> None:
    """Print workable hours by the direction that waves come from, if requested."""
    from riserstudy.seas.by_direction import by_direction

    if sectors:
        print(f"{of}workable hours by the direction that waves come from:")
        show(by_direction(found, record, sectors), None)


def waiting(found: Hours) -> list[str]:
    """A line about rows that meet all limits before operations have resumed, if there are any."""
    if not found.waiting:
        return []
    return [f"waiting to resume: {found.waiting:.2%} of the rows, which meet all other limits"]


def held_back(sea: xr.Dataset, limits: list[SeaLimit], resumes: list[SeaLimit], last: Ahead) -> None:
    """Predict the last years from the previous years, and print the comparison."""
    import numpy as np

    from riserstudy.seas.hours import hours, whole

    year = sea["time"].values.astype("datetime64[Y]").astype(int) + 1970
    recorded = [one.year for one in whole(hours(sea, limits, resumes).years)]
    if len(recorded) <= last.years:
        raise InputError(
            "--hold-back",
            str(last.years),
            "no earlier years of the record remain for the prediction",
            "hold back fewer years",
        )
    first = recorded[-last.years]
    known, observed = (
        hours(sea.isel(time=np.flatnonzero(at)), limits, resumes) for at in (year < first, year >= first)
    )
    predicted = known.next_years(*last)
    inside = predicted.low <= observed.band.share <= predicted.high
    outcome = "" if math.isnan(predicted.low) else ": inside" if inside else ": outside"
    share = f"{observed.band.share:.2%}{outcome}"
    print(f"held back from {first} on: predicted {banded(predicted)}, observed {share}")


def banded(of: Band) -> str:
    """A share with its band."""
    if math.isnan(of.low):
        return f"{of.share:.2%} (no band: only one year, or equal years)"
    return f"{of.share:.2%} ({of.low:.2%} to {of.high:.2%} with 90 % probability)"


def _share(of: float) -> str:
    return "an unknown share" if math.isnan(of) else f"{of:.2%}"
