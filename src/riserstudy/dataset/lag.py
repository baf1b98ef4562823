r"""Time by which one series is later than another, for the best fit of both.

.. math:: \min_k \operatorname{var}_i (a_{i+k} - b_i)

over the common time steps, from cumulative sums and one correlation by Fourier transform.

References
----------
Elementary: least squares; the correlation theorem.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
# difference of two fits, as a share of the other series' variance, up to which they are equally good
ALIKE = 0.01
MOST_STEPS = 2_000_000  # largest number of equally spaced times


def lag(along: FloatArray, ours: FloatArray, theirs: FloatArray) -> tuple[float, float]:
    """Time (s) by which ours is later, and the root mean square of the difference without this lag.

    The search covers a quarter of the record in both directions. Series are interpolated to equally spaced
    times, at the smallest interval of theirs, but at most two million. A periodic series fits equally well
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
    left = _left(a, b)
    half = len(even) // 4
    best = _nearest_least(left, half, ALIKE * float(np.var(b)))
    if best in (0, len(left) - 1):
        return math.nan, math.nan
    a_there, b_there = _shifted(a, b, best - half)
    rms = float(np.sqrt(np.mean((a_there - b_there) ** 2)))
    return (best - half + _between(left, best)) * step, rms


def _left(a: FloatArray, b: FloatArray) -> FloatArray:
    """Variance of a minus b, with a shifted to earlier times, (2 h + 1,): shifts from -h to h."""
    from scipy.signal import correlate  # loads half of scipy

    n, half = len(a), len(a) // 4
    middle = 0.5 * (a.mean() + b.mean())
    a, b = a - middle, b - middle
    shifts = np.arange(-half, half + 1)
    product = correlate(a, b, "full", "fft")[shifts + n - 1]
    sums = {name: np.concatenate([[0.0], np.cumsum(v)]) for name, v in
            (("a", a), ("b", b), ("aa", a * a), ("bb", b * b))}  # fmt: skip
    low_a, high_a = np.maximum(shifts, 0), n + np.minimum(shifts, 0)
    low_b, high_b = np.maximum(-shifts, 0), n - np.maximum(shifts, 0)
    count = n - np.abs(shifts)

    def of(name: str, low: NDArray[np.intp], high: NDArray[np.intp]) -> FloatArray:
        part: FloatArray = sums[name][high] - sums[name][low]
        return part

    squares = of("aa", low_a, high_a) + of("bb", low_b, high_b) - 2.0 * product
    mean = (of("a", low_a, high_a) - of("b", low_b, high_b)) / count
    left: FloatArray = np.maximum(squares / count - mean**2, 0.0)
    return left


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
