r"""Time by which one series is later than another, for the best fit of both.

.. math:: \min_k \operatorname{var}_i (a_{i+k} - b_i)

over the common time steps at which both are known, from correlations by Fourier transform.

References
----------
Elementary: least squares; the correlation theorem.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from riserstudy.records.arrays import FloatArray

# difference of two fits, as a share of the other series' variance, up to which they are equally good
ALIKE = 0.01
MOST_STEPS = 2_000_000  # largest number of equally spaced times
USUAL = 0.95  # quantile of the intervals between times that is usual, so that few gaps do not count
WIDE = 4.0  # an interval longer than this multiple of the usual interval is a gap
FEWEST = 0.1  # smallest share of the known times that a shift must leave in common


def lag(along: FloatArray, ours: FloatArray, theirs: FloatArray) -> tuple[float, float]:
    """Time (s) by which ours is later, and the root mean square of the difference without this lag.

    The search covers a quarter of the record in both directions. Series are interpolated to equally spaced
    times, at the smallest interval of theirs, but at most two million. Times within gaps are left out, where
    straight lines would be compared. A periodic series fits equally well
    one period later; of equally good lags, the one nearest to zero is returned. Both results are NaN if a
    series does not vary, or if the fit is best at an end of the search, because the lag may then be larger.
    ``along``: times (s), (n,), rising. ``ours``, ``theirs``: (n,).
    """
    if not np.ptp(ours) or not np.ptp(theirs):
        return math.nan, math.nan
    span = float(along[-1] - along[0])
    step = max(float(np.min(np.diff(along))), span / MOST_STEPS)
    even = np.arange(along[0], along[-1] + 0.5 * step, step)
    a, b = (np.interp(even, along, values) for values in (ours, theirs))
    known = _known(along, even)
    left = _left(a, b, known)
    half = len(even) // 4
    best = _nearest_least(left, half, ALIKE * float(np.var(b[known])))
    if best in (0, len(left) - 1):
        return math.nan, math.nan
    there = known.astype(float)
    both = np.multiply(*_shifted(there, there, best - half)) > 0.0
    a_there, b_there = (part[both] for part in _shifted(a, b, best - half))
    rms = float(np.sqrt(np.mean((a_there - b_there) ** 2)))
    return (best - half + _between(left, best)) * step, rms


def _known(along: FloatArray, even: FloatArray) -> NDArray[np.bool_]:
    """Whether each of the equally spaced times (s), (n,), is outside of the gaps between rising times (s)."""
    interval = np.diff(along)
    wide = interval > WIDE * float(np.quantile(interval, USUAL, method="lower"))
    into = np.clip(np.searchsorted(along, even, side="right") - 1, 0, len(interval) - 1)
    return np.asarray(~wide[into] | np.isin(even, along))


def _left(a: FloatArray, b: FloatArray, known: NDArray[np.bool_]) -> FloatArray:
    """Variance of a minus b, with a shifted to earlier times, (2 h + 1,): shifts from -h to h.

    ``known``: (n,), times at which both have values. Infinite for a shift that leaves few of them in common.
    """
    from scipy.signal import correlate  # loads half of scipy

    n, half = len(a), len(a) // 4
    middle = 0.5 * (a[known].mean() + b[known].mean())
    a, b = (np.where(known, values - middle, 0.0) for values in (a, b))
    there = known.astype(float)
    at = np.arange(-half, half + 1) + n - 1

    def of(one: FloatArray, other: FloatArray) -> FloatArray:
        product: FloatArray = correlate(one, other, "full", "fft")[at]
        return product

    count = np.rint(of(there, there))
    common = np.maximum(count, 1.0)
    squares = of(a * a, there) + of(there, b * b) - 2.0 * of(a, b)
    mean = (of(a, there) - of(there, b)) / common
    left: FloatArray = np.maximum(squares / common - mean**2, 0.0)
    return np.where(count >= FEWEST * there.sum(), left, np.inf)


def _nearest_least(left: FloatArray, half: int, alike: float) -> int:
    """Index of the smallest variance; of equally small ones, the one nearest to zero shift."""
    ends = np.concatenate([[np.inf], left, [np.inf]])
    valleys = (left <= ends[:-2]) & (left <= ends[2:]) & (left <= left.min() + alike)
    good = np.flatnonzero(valleys)
    return int(good[np.argmin(np.abs(good - half))])


def _shifted(ours: FloatArray, theirs: FloatArray, steps: int) -> tuple[FloatArray, FloatArray]:
    """Both series where they overlap, the first shifted by ``steps`` to earlier times."""
    if steps >= 0:
        return ours[steps:], theirs[: len(theirs) - steps]
    return ours[:steps], theirs[-steps:]


def _between(left: FloatArray, best: int) -> float:
    """Position of the minimum between steps, by a parabola through three values."""
    if not 0 < best < len(left) - 1:
        return 0.0
    before, here, after = left[best - 1 : best + 2]
    bend = before - 2.0 * here + after
    return float(0.5 * (before - after) / bend) if bend > 0.0 else 0.0
