"""Workable hours of a record by limits on the sea: by month and year, windows, waits, bands."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.table import Cell, Table
from riserstudy.errors import InputError
from riserstudy.inputs.misfit import Misfit
from riserstudy.records.words import counted
from riserstudy.scene.units import to_si
from riserstudy.seas.columns import NAMES, Column, plain
from riserstudy.seas.lost_hours import Lost, lost_by
from riserstudy.seas.record import interval_of_rows, next_to_each_other, rows_of
from riserstudy.seas.sea_states import without_waves
from riserstudy.seas.stops import in_operation
from riserstudy.seas.windows import Wait, Windows, statistics_of, waits, windows
from riserstudy.seas.year_bands import Band, band, band_of_next
from riserstudy.seas.years import WHOLE, Year, by_year
from riserstudy.study.months import MONTHS, hours_of_month, month_of, uneven_months
from riserstudy.study.persistence import PERSISTENCE
from riserstudy.study.spacing import check_spacing, one_per_interval

if TYPE_CHECKING:
    import xarray as xr

# relative rounding error of values in single precision, or converted from other units
ROUNDING = 1e-6
PERIODS = ("peak_period", "zero_crossing_period")  # quantities that a sea without waves does not have
NAMED = 6  # largest number of months in a line
NONE = np.zeros(0, bool)  # rows of a month without records
_LIMIT = re.compile(r"\s*(?P<name>[\w ]+?)\s*(?P<sign><=|>=)\s*(?P<value>.+?)\s*")


class SeaLimit(NamedTuple):
    """A limit on a quantity of the sea, such as ``hs <= 2.5 m``."""

    quantity: Column
    largest: bool  # whether it is an upper limit
    value: float  # in the SI unit

    def __str__(self) -> str:
        sign = "<=" if self.largest else ">="
        return f"{self.quantity.long_name} {sign} {self.value:g} {self.quantity.unit}"

    def met(self, record: xr.Dataset) -> NDArray[np.bool_]:
        """Whether each row meets it within rounding; a row without a value does not, unless it is calm."""
        values = record[self.quantity.name].values
        slack = ROUNDING * abs(self.value)
        below, above = values <= self.value + slack, values >= self.value - slack
        return np.asarray((below if self.largest else above) | self.calm(record))

    def calm(self, record: xr.Dataset) -> NDArray[np.bool_]:
        """Rows without waves that lack the limited period, (rows,): it has no effect in them."""
        lacking = np.isnan(record[self.quantity.name].values)
        return np.asarray(lacking & without_waves(record) & (self.quantity.name in PERIODS))


class Hours(NamedTuple):
    """Workable hours of a record."""

    rows: int  # number of rows with all quantities of the limits
    lacking: int  # number of rows without one of them, which are not counted
    interval: float  # h
    workable: NDArray[np.bool_]  # for each of these rows
    time: NDArray[np.datetime64]
    years: list[Year]
    joined: NDArray[np.bool_]  # (rows - 1,) whether no gap is between a row and the next
    # hours lost by limits on the sea; for one such limit alone, these are all hours that are not workable
    lost: Sequence[Lost] = ()
    waiting: float = 0.0  # share of rows that meet all limits, but in which operations have not resumed
    between: int = 0  # number of rows between these rows, closer than an interval, which are not counted

    @property
    def share(self) -> float:
        """Ratio of workable rows to all rows."""
        return float(self.workable.mean())

    @property
    def partial_years(self) -> list[Year]:
        """Years that bands exclude."""
        return [year for year in self.years if year not in whole(self.years)]

    def of_windows(self, hours: float) -> Windows:
        """Windows of a length in hours.

        Raises InputError when that is no whole number of the record's intervals.
        """
        return windows(self.workable, self.joined, rows_of(hours, self.interval))

    def of_waits(self, hours: float) -> list[tuple[str, Wait]]:
        """Waits for a window of a length in hours, for all starts and by month of the start.

        Raises InputError when that is no whole number of the record's intervals.
        """
        every = waits(self.workable, self.joined, rows_of(hours, self.interval), self.interval)
        month = month_of(self.time)
        of = [("all", np.ones(len(month), bool))]
        of += [(MONTHS[k], month == k) for k in range(12) if (month == k).any()]
        return [(name, statistics_of(type(every)(every.hours[at], every.known[at]))) for name, at in of]

    @property
    def band(self) -> Band:
        """The band of a mean year, from nearly complete years, with the default persistence."""
        return self.mean_year()

    def mean_year(self, persistence: float = PERSISTENCE) -> Band:
        """The band of a mean year, from nearly complete years.

        ``persistence``: Hurst exponent of their shares; 0.5: years do not depend on one another.
        """
        return band(whole(self.years), persistence)

    def next_years(self, count: int, persistence: float = PERSISTENCE) -> Band:
        """The band of ``count`` future years, from nearly complete years.

        ``persistence``: Hurst exponent of their shares; 0.5: years do not depend on one another.
        """
        return band_of_next(whole(self.years), count, persistence)

    def by_month(self) -> Table:
        """Share of workable hours by month and year, in per cent; empty for incomplete months."""
        months = self._months
        rows: list[list[Cell]] = []
        for one in self.years:
            cells: list[Cell] = [
                round(100.0 * float(of.mean()), 1) if self._whole(of, one.year, k) else ""
                for k in range(12)
                for of in [months.get((one.year, k), NONE)]
            ]
            total = [round(100.0 * one.share, 1), round(100.0 * one.recorded, 1)]
            rows.append([str(one.year), *cells, *total])
        units = ["", *["%"] * 14]
        return Table(["year", *MONTHS, "workable", "recorded"], units, rows)

    def of_months(self) -> list[float]:
        """Share of workable hours of each calendar month; NaN if it is complete in no year."""
        month = month_of(self.time)
        there = {k for (year, k), of in self._months.items() if self._whole(of, year, k)}
        return [float(self.workable[month == k].mean()) if k in there else math.nan for k in range(12)]

    @property
    def notes(self) -> list[str]:
        """Notes on incomplete months, and on unequal coverage of months."""
        months = self._months
        numbers = [12 * year + k for year, k in months]
        first, last = min(numbers, default=0), max(numbers, default=-1)
        partial = [
            f"{MONTHS[k]} {year}"
            for year, k in (divmod(n, 12) for n in range(first, last + 1))
            if not self._whole(months.get((year, k), NONE), year, k)
        ]
        more = f" and {len(partial) - NAMED} more" if len(partial) > NAMED else ""
        named = (
            f"months without a share, because less than {WHOLE:.0%} is recorded: {', '.join(partial[:NAMED])}"
        )
        between = (
            f"{counted(self.between, 'row')} between rows that are {self.interval:g} h apart: not counted, "
            "because each row counts as one interval"
        )
        lines = [(uneven_months(self.time), True), (f"{named}{more}", partial), (between, self.between)]
        return [line for line, there in lines if line and there]

    @property
    def _months(self) -> dict[tuple[int, int], NDArray[np.bool_]]:
        """Whether each row is workable, for each year and month (0: January) with rows."""
        month = self.time.astype("datetime64[M]").astype(int)
        order = np.argsort(month, kind="stable")
        found, first = np.unique(month[order], return_index=True)
        parts = np.split(self.workable[order], first)[1:]
        return {(1970 + int(k) // 12, int(k) % 12): of for k, of in zip(found, parts, strict=True)}

    def _whole(self, rows: NDArray[np.bool_], year: int, month: int) -> bool:
        """Whether rows are nearly a complete month (0: January)."""
        return len(rows) * self.interval >= WHOLE * hours_of_month(year, month)


def sea_limit(text: str, option: str = "--limit") -> SeaLimit:
    """The limit of a text such as ``hs <= 2.5 m``, which an option has.

    Raises InputError when it names no quantity of the sea, has no unit, or has an impossible value.
    """
    allowed = "write, for example, 'significant_wave_height <= 2.5 m'"
    match = _LIMIT.fullmatch(text)
    quantity = NAMES.get(plain(match["name"])) if match else None
    if match is None or quantity is None or quantity.unit == "deg":
        raise InputError(option, text, "this is not a limit on a quantity of the sea", allowed)
    try:
        value = to_si(match["value"], quantity.unit)
    except Misfit as error:
        raise InputError(option, text, error.found, error.allowed) from None
    if not quantity.least <= value <= quantity.most:
        possible = f"{quantity.least:g} to {quantity.most:g} {quantity.unit}"
        raise InputError(option, text, "the value is impossible", f"write a value from {possible}")
    return SeaLimit(quantity, match["sign"] == "<=", value)


def hours(record: xr.Dataset, limits: Sequence[SeaLimit], resumes: Sequence[SeaLimit] = ()) -> Hours:
    """Workable hours of a record by limits on the sea.

    ``resumes``: limits that operations also need in order to resume after a stop.

    Raises InputError when the record lacks a quantity that a limit names, or all of its values.
    """
    every = rows_with_values(record, [*limits, *resumes])
    known = one_each(record, every)
    met = {str(one): one.met(record)[known] for one in limits}
    workable = np.all([*met.values()], axis=0)
    lost = lost_by(met, np.ones(len(workable), bool)) if len(met) > 1 else []
    resuming = resuming_in(record, resumes)[known]
    return hours_of(record, every, known, workable, resuming)._replace(lost=lost)


def resuming_in(record: xr.Dataset, resumes: Sequence[SeaLimit]) -> NDArray[np.bool_]:
    """For each row, whether it meets all limits for resuming, (rows,)."""
    each = [one.met(record) for one in resumes]
    return np.asarray(np.all([np.ones(record.sizes["time"], bool), *each], axis=0))


def check_limits(record: xr.Dataset, limits: Sequence[SeaLimit]) -> None:
    """Check that a record has the quantities that limits name. Raises InputError if it does not."""
    for one in limits:
        if one.quantity.name not in record:
            there = ", ".join(sorted(map(str, record.data_vars)))
            found = "the record has no such column"
            raise InputError("--limit", one.quantity.name, found, f"use one of {there}")


def check_resumes(limits: Sequence[SeaLimit], resumes: Sequence[SeaLimit]) -> None:
    """Check that limits for resuming are stricter than limits of operation on the same quantity.

    Raises InputError for the first that is not.
    """
    for one in resumes:
        for limit in limits:
            same = (limit.quantity, limit.largest) == (one.quantity, one.largest)
            if same and (one.value >= limit.value if one.largest else one.value <= limit.value):
                found = f"not stricter than the limit {limit}, so it has no effect"
                raise InputError("--resume", str(one), found, "give a stricter limit, or omit it")


def idle_limits(record: xr.Dataset, limits: Sequence[SeaLimit]) -> list[str]:
    """Warnings about limits that all rows of a record meet, or none.

    Raises InputError when the record lacks a quantity that a limit names, or all of its values.
    """
    known, sentences = rows_with_values(record, limits), []
    for one in limits:
        met, unit = one.met(record)[known], one.quantity.unit
        values = record[one.quantity.name].values[known & ~one.calm(record)]
        if len(values) and (met.all() or not met.any()):
            sentences.append(
                f"{one}: {'every row meets' if met.all() else 'no row meets'} this limit; values of the "
                f"record are {values.min():.3g} to {values.max():.3g} {unit}"
            )
    return sentences


def rows_with_values(record: xr.Dataset, limits: Sequence[SeaLimit]) -> NDArray[np.bool_]:
    """For each row, whether it has all quantities that limits name, (rows,); calm rows need no period.

    Raises InputError when the record lacks a quantity that a limit names, or no row has all of them.
    """
    check_limits(record, limits)
    every = np.ones(record.sizes["time"], bool)
    needed = [np.isfinite(record[one.quantity.name].values) | one.calm(record) for one in limits]
    known = np.asarray(np.all([every, *needed], axis=0))
    if not known.any():
        names = ", ".join(one.quantity.name for one in limits)
        found = "no row of the record has all these values"
        raise InputError("--limit", names, found, "give a record with these values")
    return known


def one_each(record: xr.Dataset, known: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Known rows, (rows,), without those between two others that are one interval apart."""
    time = record["time"].values[known]
    kept = known.copy()
    kept[known] = one_per_interval(time, interval_of_rows(time, float(record.attrs["interval_hours"])))
    return kept


def hours_of(
    record: xr.Dataset,
    every: NDArray[np.bool_],
    known: NDArray[np.bool_],
    met: NDArray[np.bool_],
    resuming: NDArray[np.bool_],
) -> Hours:
    """Workable hours of a record.

    Raises InputError when known rows have another interval in a part of the record.

    Parameters
    ----------
    every : (rows,) true for rows with all values.
    known : (rows,) true for those that count, from `one_each`.
    met, resuming : (known,) whether these rows meet the limits of operation, and those for resuming.
    """
    time = record["time"].values[known]
    check_spacing("RECORD", record["time"].values[every])
    interval = interval_of_rows(time, float(record.attrs["interval_hours"]))
    joined = next_to_each_other(time, interval)
    workable = in_operation(met, resuming, joined)
    years = by_year(time, workable, interval)
    return Hours(
        len(time),
        int((~every).sum()),
        interval,
        workable,
        time,
        years,
        joined,
        waiting=float((met & ~workable).mean()),
        between=int((every & ~known).sum()),
    )


def whole(years: list[Year]) -> list[Year]:
    """Nearly complete years; all years if none is. A part of a year is not representative of others."""
    return [year for year in years if year.recorded >= WHOLE] or years
