"""Check that the rows of a record have one interval, because each row counts as one interval."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError
from riserstudy.records.numerals import percent

# distance of rows, in usual intervals, above which a gap is between them; its inverse: below which they are
# closer than usual
FURTHER = 1.25
ALIKE = 0.05  # relative difference below which two gaps have equal lengths
# number of successive equal gaps that are another interval; gaps at random are hardly ever so alike
SUCCESSIVE = 8
MOST = 0.01  # largest share of the recorded time, and of the rows, with another interval


def check_spacing(where: Path | str, time: NDArray[np.datetime64]) -> None:
    """Check that rows do not have a longer or a shorter interval than usual for a part of a record.

    Each row counts equally, so a part with a longer interval would count too little, and a part with a
    shorter one too much. Gaps of unequal lengths, or single gaps, are allowed. Raises InputError with the
    first and last time of the longest part if parts with another interval are more than a hundredth of the
    recorded time, or of the rows.

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
    other = (steps > FURTHER * usual) | (steps < usual / FURTHER)
    parts = stretches(other, np.abs(np.diff(steps)) <= ALIKE * steps[1:])
    parts = parts[parts[:, 1] - parts[:, 0] >= SUCCESSIVE]
    hours = np.array([float(steps[first:last].sum()) for first, last in parts])
    if not len(parts):
        return
    recorded = float(hours.sum() + steps[~other].sum())
    of_time = float(hours.sum()) / recorded
    of_rows = float((parts[:, 1] - parts[:, 0]).sum()) / len(steps)
    if max(of_time, of_rows) <= MOST:
        return
    first, last = parts[hours.argmax()]
    found = (
        f"rows with values are {steps[first]:g} h apart from {_minute(time[first])} to "
        f"{_minute(time[last])}, and most rows {usual:g} h; rows with another interval are "
        f"{percent(of_time)} of the time and {percent(of_rows)} of the rows"
    )
    longer = max(float(steps[first]), usual)
    allowed = f"keep only rows that are {longer:g} h apart, because each row counts equally"
    raise InputError(where, "time", found, allowed)


def one_per_interval(time: NDArray[np.datetime64], interval: float) -> NDArray[np.bool_]:
    """Whether each row (n,) counts: not if it is between two others that are one interval apart.

    Each row counts as one interval, and a report at half past, for example, would count twice. A row that is
    early because a clock was set is kept: without it, there would be a gap.

    Parameters
    ----------
    time : increasing times, (n,).
    interval : usual time between rows, in the unit h.
    """
    hours = np.append((time - time[:1]) / np.timedelta64(1, "s") / 3600.0 / interval, np.inf)
    kept = np.ones(len(time), bool)
    for row in map(int, np.flatnonzero(np.diff(hours[:-1]) < 1.0 / FURTHER) + 1):
        before = _kept_before(kept, row)
        apart, without = hours[[row, row + 1]] - hours[before]
        if apart >= 1.0 / FURTHER or without > FURTHER:
            continue
        # of the two rows that are close, the one that fits the usual interval less does not count
        earlier = _kept_before(kept, before)
        fits = [_unevenness(hours[[earlier, one, row + 1]]) for one in (row, before)]
        kept[before if earlier >= 0 and fits[0] < fits[1] else row] = False
    return kept


def _kept_before(kept: NDArray[np.bool_], row: int) -> int:
    """The latest row before a row that counts; below 0: none."""
    before = row - 1
    while before >= 0 and not kept[before]:
        before -= 1
    return before


def _unevenness(hours: NDArray[np.float64]) -> float:
    """Largest deviation of the distances of successive rows from one interval; hours in intervals."""
    return float(np.abs(np.diff(hours) - 1.0).max())


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
