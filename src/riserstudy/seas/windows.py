"""Hours, windows and waits in a record of which each hour is workable or not; a window ends at a gap."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Flags = NDArray[np.bool_]
MOST_LONGER = 0.01  # share of waits beyond the longest, with which their mean is told


class Windows(NamedTuple):
    """Stretches of workable rows without a gap that are long enough."""

    number: int
    inside: float  # share of all rows that lie inside one
    starts: float  # share of all rows at which work may start and be done in time


class Waits(NamedTuple):
    """Hours from a row to the next one at which work may start; of a wait that meets a gap a lower bound."""

    hours: NDArray[np.float64]  # (n,)
    known: Flags  # (n,) false where a gap or the record's end comes before


class Wait(NamedTuple):
    """Statistics of waits, with those counted that are known to be longer only."""

    mean: float
    p50: float
    p90: float
    open: int  # waits that meet a gap


def stretches(workable: Flags, joined: Flags) -> NDArray[np.int64]:
    """First row and row after the last of each stretch of workable rows, (k, 2).

    Parameters
    ----------
    joined : (n - 1,) whether a row and the next are one interval apart.
    """
    before = np.concatenate([[False], workable[:-1] & joined])
    after = np.concatenate([workable[1:] & joined, [False]])
    first = np.flatnonzero(workable & ~before)
    last = np.flatnonzero(workable & ~after) + 1
    return np.column_stack([first, last])


def windows(workable: Flags, joined: Flags, rows: int) -> Windows:
    """Windows of at least so many rows."""
    length = np.diff(stretches(workable, joined), axis=1)[:, 0]
    long = length[length >= rows]
    n = len(workable)
    return Windows(len(long), long.sum() / n, (long - rows + 1).sum() / n)


def waits(workable: Flags, joined: Flags, rows: int, interval: float) -> Waits:
    """How long each row waits for a window of so many rows (interval: hours between rows).

    What the sea does in a gap is not known: a wait that meets one, or the record's end, is longer than that.
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
    return Waits(np.where(known, following - rows_on, end - rows_on + 1) * interval, known)


def statistics_of(found: Waits) -> Wait:
    """Mean, median and 90 % of waits by the product-limit estimate, which counts what is known of open ones.

    NaN where the record does not reach so far: of the mean, where more waits than a few last longer.

    References
    ----------
    Kaplan and Meier, 1958, J. Am. Stat. Assoc. 53.
    """
    from scipy.stats import CensoredData, ecdf

    if not found.known.any():
        return Wait(np.nan, np.nan, np.nan, int((~found.known).sum()))
    still = ecdf(CensoredData.right_censored(found.hours, ~found.known)).sf
    hours, share = np.asarray(still.quantiles), np.asarray(still.probabilities)
    steps = np.diff(np.concatenate([[0.0], hours]))
    whole = float((steps * np.concatenate([[1.0], share[:-1]])).sum())
    mean = whole if share[-1] <= MOST_LONGER else np.nan
    p50, p90 = (
        float(hours[(share <= 1.0 - q + 1e-12).argmax()])
        if (share <= 1.0 - q + 1e-12).any()
        else np.nan
        for q in (0.5, 0.9)
    )
    return Wait(mean, p50, p90, int((~found.known).sum()))
