"""Statistics of responses to irregular seas: of one record, and of the extremes of several seeds."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
FEWEST_PEAKS = 10  # of a record, from which a distribution is fitted
LOWER = 0.5  # share of peaks, the smallest, that the fit leaves out
GRINGORTEN = 0.44  # of his plotting positions
FEWEST_SEEDS = 5
ALIKE = 1e-3  # deviation of peaks over their mean, below which a motion is regular
SAME = 1e-10  # difference of extremes over their magnitude, up to which they are the same
NOT_EXCEEDED = 0.9  # share of seas whose extreme stays within the fractile that is told


class Statistics(NamedTuple):
    """Of one record, in its own unit; not a number where it has too few peaks."""

    mean: float
    deviation: float
    period: float  # mean time between upcrossings of the mean (s)
    largest: float
    most_probable_largest: float  # in the time of exposure
    smallest: float
    most_probable_smallest: float


class Gumbel(NamedTuple):
    """The Gumbel distribution of largest values, one a seed."""

    mode: float  # the most probable largest value
    scale: float
    fractile: float  # that nine seas in ten do not exceed
    mode_error: float  # standard error of the mode


def record_statistics(time: FloatArray, values: FloatArray, exposure: float) -> Statistics:
    """Statistics of a record, and the most probable extremes in a time of exposure.

    Peaks are one between each upcrossing of the mean and the next. Their higher half follows a Weibull
    distribution of which shape and scale are fitted; of a Gaussian process that is nearly Rayleigh's, of
    shape 2. Among N peaks the most probable largest is mean + scale (ln N)^(1 / shape). The lower half is
    left out: small peaks, of which a sea of a broad band has many, say little of the largest.

    Parameters
    ----------
    time, values : of the record, (n,); time in s, evenly spaced.
    exposure : time (s) for which extremes are told.

    References
    ----------
    Ochi 1998, Ocean Waves: The Stochastic Approach, chapters 3 and 6. Gringorten 1963, J. Geophys. Res. 68,
    for the chances of ordered values.
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
    """Number (crossings,) of the first of some values, (n,) in any unit, after each upcrossing of zero."""
    return np.asarray(np.flatnonzero((values[:-1] < 0.0) & (values[1:] >= 0.0)) + 1)


def peaks(values: FloatArray) -> FloatArray:
    """Largest of some values, (n,), between each upcrossing of zero and the next, (peaks,), in their unit."""
    starts = upcrossings(values)
    if len(starts) < 2:
        return np.empty(0)
    return np.asarray(np.maximum.reduceat(values[: starts[-1]], starts[:-1]))


def _most_probable(found: FloatArray, count: float) -> float:
    """Most probable largest of so many peaks of the distribution that some peaks have."""
    if len(found) < FEWEST_PEAKS or not count > 1.0:
        return math.nan
    if found.std() <= ALIKE * found.mean():
        return float(found.max())  # of a regular motion, for which no shape can be fitted
    higher = np.sort(found)
    not_exceeded = (np.arange(len(higher)) + 1.0 - GRINGORTEN) / (
        len(higher) + 1.0 - 2.0 * GRINGORTEN
    )
    some = (not_exceeded > LOWER) & (higher > 0.0)
    slope, log_scale = np.polyfit(np.log(-np.log1p(-not_exceeded[some])), np.log(higher[some]), 1)
    return float(np.exp(log_scale) * math.log(count) ** slope)


def gumbel(largest: ArrayLike) -> Gumbel:
    """The Gumbel distribution that largest values, one a seed, are most likely from.

    References
    ----------
    Gumbel 1958, Statistics of Extremes; the mode's standard error is that of maximum likelihood,
    1.053 scale / sqrt(n).
    """
    from scipy.stats import gumbel_r

    values: Any = np.asarray(largest, float)
    if np.ptp(values) <= SAME * np.abs(values).max():  # of what no sea moves
        return Gumbel(float(values.mean()), 0.0, float(values.max()), 0.0)
    mode, scale = gumbel_r.fit(values)
    fractile = gumbel_r.ppf(NOT_EXCEEDED, mode, scale)
    error = math.sqrt(1.0 + 6.0 * (1.0 - np.euler_gamma) ** 2 / math.pi**2) * scale
    return Gumbel(float(mode), float(scale), float(fractile), float(error / math.sqrt(len(values))))
