"""Windows and waits in a record whose rows are workable or not; a window ends at a gap."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.study.spacing import stretches

Flags = NDArray[np.bool_]
# largest share of waits longer than the longest known one for which a mean is given
MOST_LONGER = 0.01


class Windows(NamedTuple):
    """Sufficiently long periods of workable rows without a gap.

    The shares are of the rows for which the sea in gaps changes nothing; NaN without such rows.
    """

    number: int
    inside: float  # share of rows within a window
    starts: float  # share of rows at which work may start and end in time


class Waits(NamedTuple):
    """Hours from each row to the next row at which work may start; a lower bound for waits with a gap.

    Waits below the lower bound are excluded; a wait may be equal to it.
    """

    hours: NDArray[np.float64]  # (n,)
    # (n,) false if the rows before a gap, or before the end of the record, do not show the start of work
    known: Flags


class Wait(NamedTuple):
    """Statistics of waits, including waits of which only a lower bound is known."""

    mean: float
    p50: float
    p90: float
    open: int  # number of waits that a gap or the record's end interrupts


def windows(workable: Flags, joined: Flags, rows: int) -> Windows:
    """Windows with at least ``rows`` rows."""
    inside, starts = np.zeros(len(workable), bool), _starts(workable, joined, rows)
    long = [(first, last) for first, last in stretches(workable, joined) if last - first >= rows]
    for first, last in long:
        inside[first:last] = True
    before, after = _rows_to_gaps(joined, len(workable))
    ends = after >= rows - 1  # a window from here ends before the gap
    around = ends & (before >= rows - 1)  # so does each window that contains the row, and starts after a gap
    return Windows(len(long), _share(inside[around]), _share(starts[ends]))


def _starts(workable: Flags, joined: Flags, rows: int) -> Flags:
    """Whether a window of ``rows`` rows can start at each row, (n,)."""
    starts = np.zeros(len(workable), bool)
    for first, last in stretches(workable, joined):
        starts[first : max(last - rows + 1, first)] = True
    return starts


def _rows_to_gaps(joined: Flags, n: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Number of rows before and after each row without a gap, (n,) each."""
    rows_on = np.arange(n)
    ends = np.append(np.flatnonzero(~joined), n - 1)  # last rows before gaps
    part = np.searchsorted(ends, rows_on)
    firsts = np.concatenate([[0], ends[:-1] + 1])
    return rows_on - firsts[part], ends[part] - rows_on


def _share(of: Flags) -> float:
    return float(of.mean()) if of.size else np.nan


def waits(workable: Flags, joined: Flags, rows: int, interval: float) -> Waits:
    """Wait from each row for a window of ``rows`` rows (interval: hours between rows).

    The sea in a gap is not known, so the last rows before a gap, or before the record's end, do not show
    whether a window starts there, unless one has started before. This must not depend on the sea in these
    rows: they would otherwise count as rows without a start wherever they are not workable, and as unknown
    wherever they are. The lower bound of a wait therefore ends at the first row whose window would reach
    into the gap.
    """
    n = len(workable)
    rows_on = np.arange(n)
    following = np.where(_starts(workable, joined, rows), rows_on, n)
    following = np.minimum.accumulate(following[::-1])[::-1]
    end = rows_on + _rows_to_gaps(joined, n)[1]
    known = following <= end
    undecided = end - rows + 2  # first row whose window would not end before the gap
    least = np.maximum(undecided - rows_on, 0)
    return Waits(np.where(known, following - rows_on, least) * interval, known)


def statistics_of(found: Waits) -> Wait:
    """Mean, median and 90 % quantile of waits, by the product-limit estimate, which includes lower bounds.

    NaN where the record is too short; for the mean, if more than a few waits are longer than the longest
    known one.

    References
    ----------
    Kaplan and Meier, 1958, J. Am. Stat. Assoc. 53.
    """
    from scipy.stats import CensoredData, ecdf

    if not found.known.any():
        return Wait(np.nan, np.nan, np.nan, int((~found.known).sum()))
    # a wait may be equal to its lower bound: there, it is no longer among the waits that have not ended
    hours = np.where(found.known, found.hours, np.nextafter(found.hours, -np.inf))
    still = ecdf(CensoredData.right_censored(hours, ~found.known)).sf
    hours, share = np.asarray(still.quantiles), np.asarray(still.probabilities)
    steps = np.diff(np.concatenate([[0.0], hours]))
    whole = float((steps * np.concatenate([[1.0], share[:-1]])).sum())
    mean = whole if share[-1] <= MOST_LONGER else np.nan
    p50, p90 = (
        float(hours[(share <= 1.0 - q + 1e-12).argmax()]) if (share <= 1.0 - q + 1e-12).any() else np.nan
        for q in (0.5, 0.9)
    )
    return Wait(mean, p50, p90, int((~found.known).sum()))
