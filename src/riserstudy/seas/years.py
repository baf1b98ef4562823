"""Share of workable hours with a band, by years drawn with replacement, of a mean year and years to come."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

DRAWS = 4000
BAND = (0.05, 0.95)
WHOLE = 0.8  # of a year's hours that are to be recorded for it to count as one


class Band(NamedTuple):
    """A share, and where nine in ten of what years drawn with replacement give lie; NaN of one year."""

    share: float
    low: float
    high: float


class Year(NamedTuple):
    """Rows of a year and how many are workable."""

    year: int
    rows: int
    workable: int
    recorded: float  # share of the year's hours

    @property
    def share(self) -> float:
        """Workable rows over all."""
        return self.workable / self.rows


def by_year(
    time: NDArray[np.datetime64], workable: NDArray[np.bool_], interval: float
) -> list[Year]:
    """Rows a year (interval: hours between rows)."""
    years = time.astype("datetime64[Y]").astype(int) + 1970
    found = []
    for year in np.unique(years):
        of = years == year
        begin, end = (np.datetime64(str(y), "h") for y in (year, year + 1))
        hours = (end - begin) / np.timedelta64(1, "h")
        rows = int(of.sum())
        found.append(Year(int(year), rows, int(workable[of].sum()), rows * interval / hours))
    return found


def band(years: list[Year], seed: int = 0) -> Band:
    """Of the mean over many years: each draw is as many years as there are."""
    return _drawn(years, len(years), np.random.default_rng(seed), again=False)


def band_of_next(years: list[Year], count: int, seed: int = 0) -> Band:
    """Of so many years to come: which years the record happens to hold is drawn first, then those to come."""
    return _drawn(years, count, np.random.default_rng(seed), again=True)


def _drawn(years: list[Year], count: int, draw: np.random.Generator, again: bool) -> Band:
    rows = np.array([year.rows for year in years], float)
    workable = np.array([year.workable for year in years], float)
    share = float(workable.sum() / rows.sum())
    if len(years) < 2:
        return Band(share, np.nan, np.nan)
    chosen = draw.integers(len(years), size=(DRAWS, len(years)))
    if again:
        places = draw.integers(len(years), size=(DRAWS, count))
        chosen = np.take_along_axis(chosen, places, axis=1)
    shares = workable[chosen].sum(axis=1) / rows[chosen].sum(axis=1)
    low, high = np.quantile(shares, BAND)
    return Band(share, float(low), float(high))
