"""Return values of a riser's responses for long return periods, by two methods, each with a band.

A sea state does not determine the largest response of an interval, which follows a Gumbel distribution.
Histories of the record are therefore drawn, each row from its distribution, and each history is fitted like
the heights of a record.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.fit_bias import possible
from riserstudy.dataset.limits import labels
from riserstudy.dataset.statistics import FEWEST_SEEDS, NOT_EXCEEDED
from riserstudy.dataset.table import Cell, Table
from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.limits import UNITS, Limit
from riserstudy.seas.return_values import ReturnValue, drawn_of_peaks, drawn_of_years, storms, whole_years
from riserstudy.seas.riser_hours import Met
from riserstudy.seas.year_bands import BAND
from riserstudy.study.demand_in_sea import scales_of

HISTORIES = 40  # number of drawn histories of the record
DRAWS = 10  # number of values that may be true, of each history
# standard deviations of a normal distribution to both sides, for nine in ten values
NINE_IN_TEN = 1.645
REDUCED = -math.log(-math.log(NOT_EXCEEDED))  # reduced variate of demands
COLUMNS = [
    *("limit", "return period", "by years", "years from", "years to"),
    *("by storms", "storms from", "storms to", "unit"),
]
NOT_KNOWN = ReturnValue(math.nan, math.nan, math.nan)
HEADS = ["", "years", *["*"] * 6, ""]


class Demands(NamedTuple):
    """Demands of limits in each row of a record."""

    time: NDArray[np.datetime64]
    interval: float  # h
    runs: float  # length of an interval divided by the length of a run
    seeds: int
    limits: Sequence[Limit]
    rows: Met


class Returned(NamedTuple):
    """A return value of a response by both methods, in the SI unit of its output."""

    limit: Limit
    name: str  # of the limit
    years: float
    by_years: ReturnValue
    by_storms: ReturnValue


def returned(of: Demands, periods: Sequence[float], seed: int = 0) -> list[Returned]:
    """Return values of responses, for each limit whose extremes are known.

    A band contains nine in ten values that may be true by the fits to the histories. The uncertainty of the
    response changes all rows of a history together. Errors of few seeds are drawn from the errors of such
    fits, and other errors from a normal distribution whose 90 % range they are. Means have no such extremes
    and are excluded. If the response is not known in some rows, because of failed runs, these rows may have
    the largest responses, and the return values are NaN. ``periods``: return periods (years), above 1. Raises
    InputError when fewer than five years are nearly complete, or the response is from one seed.
    """
    if of.seeds < FEWEST_SEEDS:
        few = f"from {of.seeds} run per sea state, the scatter of extremes is not known"
        allowed = f"give --seeds {FEWEST_SEEDS} or more, which return values require"
        raise InputError("command line", "--seeds", few, allowed)
    draw = np.random.default_rng(seed)
    found: list[Returned] = []
    for k, (limit, name) in enumerate(zip(of.limits, labels(of.limits), strict=True)):
        if limit.side == "mean":
            continue
        sign = -1.0 if limit.side == "smallest" else 1.0
        each = _of_limit(of, k, sign, periods, draw)
        for period, both in zip(periods, each, strict=True):
            found.append(Returned(limit, name, period, *(_turned(one, sign) for one in both)))
    return found


def table_of(found: Sequence[Returned]) -> Table:
    """Results of both methods, one row per limit and return period."""
    rows: list[list[Cell]] = [
        [one.name, one.years, *one.by_years, *one.by_storms, UNITS[one.limit.output]] for one in found
    ]
    return Table(COLUMNS, HEADS, rows)


def _of_limit(
    of: Demands, number: int, sign: float, periods: Sequence[float], draw: np.random.Generator
) -> Iterator[tuple[ReturnValue, ReturnValue]]:
    """Both methods by return period, for a response whose larger values are worse."""
    demand, off, scale = (values[:, number] for values in (of.rows.demand, of.rows.off, of.rows.scale))
    above = scales_of(of.runs)
    whole = whole_years(of.time, np.ones(len(demand), bool), of.interval)
    if np.isnan(demand).any():
        yield from [(NOT_KNOWN, NOT_KNOWN)] * len(periods)
        return
    recorded = len(demand) * of.interval / 8766.0
    by_years: list[list[tuple[float, FloatArray]]] = [[] for _ in periods]
    by_storms: list[list[tuple[float, FloatArray]]] = [[] for _ in periods]
    for _ in range(HISTORIES):
        change, factor = possible(above, of.seeds, draw)
        middle = sign * demand + off / NINE_IN_TEN * draw.standard_normal() + change * scale
        values = middle + factor * scale * (draw.gumbel(size=len(demand)) - REDUCED)
        largest = np.array([values[rows].max() for rows in whole])
        peaks, threshold = storms(of.time, values, recorded)
        for k, period in enumerate(periods):
            by_years[k].append(drawn_of_years(largest, period, draw, DRAWS))
            of_peaks = drawn_of_peaks(peaks, threshold, recorded, period, draw, DRAWS)
            by_storms[k].append(of_peaks)
    for years, peaks_over in zip(by_years, by_storms, strict=True):
        yield _joined(years), _joined(peaks_over)


def _joined(of: Sequence[tuple[float, FloatArray]]) -> ReturnValue:
    """The median of all histories, and the band of all values that may be true."""
    low, high = np.quantile(np.concatenate([drawn for _, drawn in of]), BAND)
    return ReturnValue(float(np.median([value for value, _ in of])), float(low), float(high))


def _turned(of: ReturnValue, sign: float) -> ReturnValue:
    """The return value with the sign of the response."""
    low, high = sorted((sign * of.low, sign * of.high))
    return ReturnValue(sign * of.value, low, high)
