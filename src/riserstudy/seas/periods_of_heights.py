"""Log-normal distribution of peak periods for given heights, fitted to all sea states of a record.

The mean of the logarithm of the period is a + b h^c, and its standard deviation d + e exp(f h). The library
virocon fits both to bins of heights of half a metre, whose middle is not the mean height in a bin. Periods
of contours then have errors of up to 2 %, which no band from parts of the record shows. The fit here is by
maximum likelihood.

References
----------
DNV-RP-C205, 3.6.3.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from riserstudy.records.arrays import FloatArray

GROUPS = 200  # number of groups of sea states with similar heights, whose mean and variance are sufficient
#: bounds of a, b, c, d, e and f
BOUNDS = ((0.0, None), (0.0, None), (0.05, 3.0), (1e-3, None), (0.0, None), (-3.0, 1.0))


class Periods(NamedTuple):
    """Coefficients of the distribution, (6,), with heights in m and periods in s."""

    coefficients: FloatArray
    # (2,) lowest and highest height (m) between which the standard deviation changes
    between: FloatArray

    def at(self, heights: FloatArray, normal: FloatArray) -> FloatArray:
        """Peak periods (s) for heights (m) and standard normal numbers (1), (n,) each."""
        mean, deviation = _logarithm(self.coefficients, heights, self.between)
        return np.asarray(np.exp(mean + deviation * normal))


def fitted(states: FloatArray, start: Sequence[float], between: FloatArray) -> Periods:
    """The distribution of sea states.

    Parameters
    ----------
    states : (n, 2) heights (m) and peak periods (s).
    start : first coefficients, (6,), such as those by bins.
    between : (2,) lowest and highest height (m) between which the standard deviation changes.
    """
    from scipy.optimize import minimize

    count, height, mean, variance = _groups(states)

    def unlikely(coefficients: FloatArray) -> float:
        """Mean negative logarithm of the likelihood."""
        expected, deviation = _logarithm(coefficients, height, between)
        off = (mean - expected) ** 2 + variance
        return float(np.average(np.log(deviation) + 0.5 * off / deviation**2, weights=count))

    low, high = np.array([[np.inf if end is None else end for end in ends] for ends in BOUNDS]).T
    # a coefficient that is not a number begins at zero or its bound: it is only a start, beside a second one
    first = np.clip(np.nan_to_num(start), low, high)
    found = [
        minimize(unlikely, one, method="L-BFGS-B", bounds=BOUNDS, options={"maxiter": 500, "ftol": 1e-13})
        for one in (first, _even(count, height, mean, variance))
    ]
    return Periods(np.asarray(min(found, key=lambda one: float(one.fun)).x), between)


def _logarithm(
    coefficients: FloatArray, heights: FloatArray, between: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Mean and standard deviation of the logarithm of the period (s) for heights (m), as in the header."""
    a, b, c, d, e, f = coefficients
    return a + b * heights**c, d + e * np.exp(f * np.clip(heights, *between))


def _even(count: FloatArray, height: FloatArray, mean: FloatArray, variance: FloatArray) -> FloatArray:
    """Coefficients by least squares with the root of the height (m) and nearly the same deviation."""
    b, a = np.polyfit(np.sqrt(height), mean, 1, w=np.sqrt(count))
    off = (mean - a - b * np.sqrt(height)) ** 2 + variance
    deviation = float(np.sqrt(np.average(off, weights=count)))
    return np.array([max(a, 0.0), max(b, 0.0), 0.5, deviation, 0.1 * deviation, -0.5])


def _groups(states: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Number, mean height (m), and mean and variance of the logarithm of the period (s), by group."""
    height, period = states[np.argsort(states[:, 0], kind="stable")].T
    first = np.unique(np.linspace(0, len(height), GROUPS + 1).astype(int))[:-1]
    count = np.diff(first, append=len(height))
    means = [np.add.reduceat(of, first) / count for of in (height, np.log(period), np.log(period) ** 2)]
    return count.astype(float), means[0], means[1], np.maximum(means[2] - means[1] ** 2, 0.0)
