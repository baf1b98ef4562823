"""Windows and waits in a record whose rows are workable or not; a window ends at a gap."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Flags = NDArray[np.bool_]
# largest share of waits longer than the longest known one for which a mean is given
MOST_LONGER = 0.01


class Windows(NamedTuple):
    """Sufficiently long periods of workable rows without a gap."""

    number: int
    inside: float  # share of all rows within a window
    starts: float  # share of all rows at which work may start and end in time


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


def stretches(workable: Flags, joined: Flags) -> NDArray[np.int64]:
    """First row and row after the last of each period of workable rows, (k, 2).

    ``joined``: (n - 1,) whether a row and the next are one interval apart.
    """
    before = np.concatenate([[False], workable[:-1] & joined])
    after = np.concatenate([workable[1:] & joined, [False]])
    first = np.flatnonzero(workable & ~before)
    last = np.flatnonzero(workable & ~after) + 1
    return np.column_stack([first, last])


def windows(workable: Flags, joined: Flags, rows: int) -> Windows:
    """Windows with at least ``rows`` rows."""
    length = np.diff(stretches(workable, joined), axis=1)[:, 0]
    long = length[length >= rows]
    n = len(workable)
    return Windows(len(long), long.sum() / n, (long - rows + 1).sum() / n)


def waits(workable: Flags, joined: Flags, rows: int, interval: float) -> Waits:
    """Wait from each row for a window of ``rows`` rows (interval: hours between rows).

    The sea in a gap is not known, so the last rows before a gap, or before the record's end, do not show
    whether a window starts there, unless one has started before. This must not depend on the sea in these
    rows: they would otherwise count as rows without a start wherever they are not workable, and as unknown
    wherever they are. The lower bound of a wait therefore ends at the first row whose window would reach
    into the gap.
    """
    n = len(workable)
    start = np.zeros(n, bool)
    for first, last in stretches(workable, joined):
        start[first : max(last - rows + 1, first)] = True
    rows_on = np.arange(n)
    following = np.where(start, rows_on, n)
    following = np.minimum.accumulate(following[::-1])[::-1]
    ends = np.flatnonzero(~joined)  # last rows before gaps
    end = np.append(ends, n - 1)[np.searchsorted(ends, rows_on)]
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
