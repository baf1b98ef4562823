"""Numbers of rows and workable rows of a record by year."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

WHOLE = 0.8  # smallest share of recorded hours with which a year counts as complete


class Year(NamedTuple):
    """Numbers of rows and workable rows of a year."""

    year: int
    rows: int
    workable: int
    recorded: float  # share of the year's hours

    @property
    def share(self) -> float:
        """Ratio of workable rows to all rows."""
        return self.workable / self.rows


def by_year(time: NDArray[np.datetime64], workable: NDArray[np.bool_], interval: float) -> list[Year]:
    """Numbers of rows by year (interval: hours between rows)."""
    years = time.astype("datetime64[Y]").astype(int) + 1970
    found = []
    for year in np.unique(years):
        of = years == year
        begin, end = (np.datetime64(str(y), "h") for y in (year, year + 1))
        hours = (end - begin) / np.timedelta64(1, "h")
        rows = int(of.sum())
        found.append(Year(int(year), rows, int(workable[of].sum()), rows * interval / hours))
    return found
