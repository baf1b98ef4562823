r"""Time by which one series is later than another, at which both fit best.

.. math:: \min_k \operatorname{var}_i (a_{i+k} - b_i)

over the steps that both have, from cumulative sums and one correlation by Fourier's transform.

References
----------
Elementary: least squares; the correlation theorem.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ALIKE = 0.01  # of the other's variance, by which two lags fit alike
MOST_STEPS = 2_000_000  # of the even times that are compared


def lag(along: FloatArray, ours: FloatArray, theirs: FloatArray) -> tuple[float, float]:
    """Time (s) by which ours is later, and the root mean square that is left when it is taken out.

    Searched over a quarter of the record either way. Series are taken at even times, as close as the closest
    ones of theirs, but at two million at most. What repeats itself fits as well a period later: of lags that
    fit alike it is the one nearest to none. Not numbers where a series does not vary.

    Parameters
    ----------
    along : times (s), (n,), rising. ours, theirs : (n,).
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
    a_there, b_there = _shifted(a, b, best - half)
    rms = float(np.sqrt(np.mean((a_there - b_there) ** 2)))
    return (best - half + _between(left, best)) * step, rms


def _left(a: FloatArray, b: FloatArray) -> FloatArray:
    """Variance of a, taken earlier by each of the shifts, less b, (2 h + 1,): shifts from -h to h."""
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
    """Index of the least that is nearest to no shift."""
    ends = np.concatenate([[np.inf], left, [np.inf]])
    valleys = (left <= ends[:-2]) & (left <= ends[2:]) & (left <= left.min() + alike)
    good = np.flatnonzero(valleys)
    return int(good[np.argmin(np.abs(good - half))])


def _shifted(ours: FloatArray, theirs: FloatArray, steps: int) -> tuple[FloatArray, FloatArray]:
    """Both where they overlap, the first taken so many steps earlier."""
    if steps >= 0:
        return ours[steps:], theirs[: len(theirs) - steps]
    return ours[:steps], theirs[-steps:]


def _between(left: FloatArray, best: int) -> float:
    """Where between steps the least lies, by a parabola through three values."""
    if not 0 < best < len(left) - 1:
        return 0.0
    before, here, after = left[best - 1 : best + 2]
    bend = before - 2.0 * here + after
    return float(0.5 * (before - after) / bend) if bend > 0.0 else 0.0
