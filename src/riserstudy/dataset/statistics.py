"""Statistics of responses to irregular seas: for one record, and for extremes of several seeds."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
FEWEST_PEAKS = 10  # smallest number of peaks for the fit of a distribution
LOWER = 0.5  # share of the smallest peaks that the fit excludes
GRINGORTEN = 0.44  # constant of Gringorten's plotting positions
FEWEST_SEEDS = 5
ALIKE = 1e-3  # relative deviation of peaks from their mean below which a motion is regular
SAME = 1e-10  # relative difference of extremes up to which they are equal
NOT_EXCEEDED = 0.9  # share of seas whose extreme does not exceed the reported fractile


class Statistics(NamedTuple):
    """Statistics of one record, in its unit; NaN if it has too few peaks."""

    mean: float
    deviation: float
    period: float  # mean time between upcrossings of the mean (s)
    largest: float
    most_probable_largest: float  # in the exposure time
    smallest: float
    most_probable_smallest: float


class Gumbel(NamedTuple):
    """The Gumbel distribution of largest values, one per seed."""

    mode: float  # the most probable largest value
    scale: float
    fractile: float  # value that nine seas in ten do not exceed
    mode_error: float  # standard error of the mode


def record_statistics(time: FloatArray, values: FloatArray, exposure: float) -> Statistics:
    """Statistics of a record, and the most probable extremes in an exposure time.

    There is one peak between each upcrossing of the mean and the next. A Weibull distribution, with shape and
    scale as parameters, is fitted to the upper half of the peaks. For a Gaussian process it is nearly the
    Rayleigh distribution, whose shape is 2. Among N peaks, the most probable largest value is mean + scale
    (ln N)^(1 / shape). The lower half is excluded, because small peaks, of which a broad-banded process has
    many, have little relation to the largest.

    Parameters
    ----------
    time, values : the record, (n,); times in s, equally spaced.
    exposure : exposure time of the extremes (s).

    References
    ----------
    Ochi 1998, Ocean Waves: The Stochastic Approach, chapters 3 and 6. Gringorten 1963, J. Geophys. Res. 68,
    for the probabilities of ordered values.
    """
    mean, deviation = float(values.mean()), float(values.std())
    upward = peaks(values - mean)
    crossed = time[upcrossings(values - mean)]
    period = float((crossed[-1] - crossed[0]) / len(upward)) if len(upward) else math.nan
    downward = peaks(mean - values)
    return Statistics(
        mean,
        deviation,
        period,
        float(values.max()),
        mean + _most_probable(upward, exposure / period),
        float(values.min()),
        mean - _most_probable(downward, exposure / period),
    )


def upcrossings(values: FloatArray) -> NDArray[np.int64]:
    """Index (crossings,) of the first value after each upcrossing of zero; values (n,) in any unit."""
    return np.asarray(np.flatnonzero((values[:-1] < 0.0) & (values[1:] >= 0.0)) + 1)


def peaks(values: FloatArray) -> FloatArray:
    """Largest value between each upcrossing of zero and the next, (peaks,); values (n,), in the same unit."""
    starts = upcrossings(values)
    if len(starts) < 2:
        return np.empty(0)
    return np.asarray(np.maximum.reduceat(values[: starts[-1]], starts[:-1]))


def _most_probable(found: FloatArray, count: float) -> float:
    """Most probable largest of ``count`` peaks with the same distribution as the peaks ``found``."""
    if len(found) < FEWEST_PEAKS or not count > 1.0:
        return math.nan
    if found.std() <= ALIKE * found.mean():
        return float(found.max())  # a regular motion, for which no shape can be fitted
    higher = np.sort(found)
    not_exceeded = (np.arange(len(higher)) + 1.0 - GRINGORTEN) / (len(higher) + 1.0 - 2.0 * GRINGORTEN)
    some = (not_exceeded > LOWER) & (higher > 0.0)
    slope, log_scale = np.polyfit(np.log(-np.log1p(-not_exceeded[some])), np.log(higher[some]), 1)
    return float(np.exp(log_scale) * math.log(count) ** slope)


def gumbel(largest: ArrayLike) -> Gumbel:
    """The Gumbel distribution of largest values, one per seed, by maximum likelihood.

    References
    ----------
    Gumbel 1958, Statistics of Extremes; the mode's standard error is that of maximum likelihood,
    1.053 scale / sqrt(n).
    """
    from scipy.stats import gumbel_r

    values: Any = np.asarray(largest, float)
    if np.ptp(values) <= SAME * np.abs(values).max():  # the sea does not change the quantity
        return Gumbel(float(values.mean()), 0.0, float(values.max()), 0.0)
    mode, scale = gumbel_r.fit(values)
    fractile = gumbel_r.ppf(NOT_EXCEEDED, mode, scale)
    error = math.sqrt(1.0 + 6.0 * (1.0 - np.euler_gamma) ** 2 / math.pi**2) * scale
    return Gumbel(float(mode), float(scale), float(fractile), float(error / math.sqrt(len(values))))
