"""Check that the rows of a record have one interval, because each row counts as one interval."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError
from riserstudy.records.numerals import percent

FURTHER = 1.25  # distance of rows, in usual intervals, above which a gap is between them
ALIKE = 0.05  # relative difference below which two gaps have equal lengths
# number of successive equal gaps that are another interval; gaps at random are hardly ever so alike
SUCCESSIVE = 8
MOST = 0.01  # largest share of the recorded time with another interval


def check_spacing(where: Path | str, time: NDArray[np.datetime64]) -> None:
    """Check that rows do not have a longer interval than usual for a part of a record.

    Each row counts equally, so a part with a longer interval would count too little. Gaps of unequal lengths,
    or single gaps, are allowed. Raises InputError with the first and last time of the longest part if parts
    with a longer interval are more than a hundredth of the recorded time.

    Parameters
    ----------
    where : file or option, in errors.
    time : (n,) increasing times of rows with values.
    """
    steps = np.diff(time) / np.timedelta64(1, "s") / 3600.0
    if len(steps) <= SUCCESSIVE:
        return
    lengths, counts = np.unique(steps, return_counts=True)
    usual = float(lengths[counts.argmax()])
    wide = steps > FURTHER * usual
    parts = stretches(wide, np.abs(np.diff(steps)) <= ALIKE * steps[1:])
    parts = parts[parts[:, 1] - parts[:, 0] >= SUCCESSIVE]
    hours = np.array([float(steps[first:last].sum()) for first, last in parts])
    recorded = float(hours.sum() + steps[~wide].sum())
    if not len(parts) or hours.sum() <= MOST * recorded:
        return
    first, last = parts[hours.argmax()]
    found = (
        f"rows with values are {steps[first]:g} h apart from {_minute(time[first])} to "
        f"{_minute(time[last])}, and most rows {usual:g} h; rows with a longer interval are "
        f"{percent(hours.sum() / recorded)} of the time"
    )
    allowed = f"keep only rows that are {steps[first]:g} h apart, because each row counts equally"
    raise InputError(where, "time", found, allowed)


def stretches(flags: NDArray[np.bool_], joined: NDArray[np.bool_]) -> NDArray[np.int64]:
    """First row and row after the last of each period of successive rows with a flag, (k, 2).

    ``flags``: (n,). ``joined``: (n - 1,) whether a row and the next can be in one period, such as rows that
    are one interval apart.
    """
    before = np.concatenate([[False], flags[:-1] & joined])
    after = np.concatenate([flags[1:] & joined, [False]])
    first = np.flatnonzero(flags & ~before)
    last = np.flatnonzero(flags & ~after) + 1
    return np.column_stack([first, last])


def _minute(time: np.datetime64) -> str:
    return str(time.astype("datetime64[m]")).replace("T", " ")
