"""Statistics of responses to irregular seas: for one record, and for extremes of several seeds.

Outputs miss the peaks between them. Peaks and crossings are therefore those of a spline of fifth degree
through the outputs. For motion with `IN_A_PERIOD` or more outputs in its period, peaks have errors of 1 %.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from riserstudy.dataset.fit_bias import corrected, error_of
from riserstudy.dataset.further_seas import fitted, scales_above_mode
from riserstudy.records.arrays import FloatArray

FEWEST_PEAKS = 10  # smallest number of peaks for the fit of a distribution
LOWER = 0.5  # share of the smallest peaks that the fit excludes
GRINGORTEN = 0.44  # constant of Gringorten's plotting positions
FEWEST_SEEDS = 5
ALIKE = 1e-3  # relative deviation of peaks from their mean below which a motion is regular
SAME = 1e-10  # relative difference of extremes up to which they are equal
DEGREE = 5  # of the spline through the outputs
# largest difference of a sine from four outputs in its period, divided by their second difference
EXCESS = (math.sqrt(2.0) - 1.0) / 2.0
ENDS = 2  # intervals at each end of a record, in which the spline oscillates, and values are linear
BETWEEN = 16  # values of the spline in an interval of outputs
IN_A_PERIOD = 4.0  # outputs in a period: with fewer, the spline misses peaks
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
    """The Gumbel distribution of largest values, one per seed, without the mean error of a fit to few."""

    mode: float  # the most probable largest value
    scale: float
    # value that nine further seas in ten do not exceed; because of the errors of the fit, it is more than
    # 2.25 scales above the mode
    fractile: float
    mode_error: float  # standard error of the mode


def record_statistics(time: FloatArray, values: FloatArray, exposure: float) -> Statistics:
    """Statistics of a record, and the most probable extremes in an exposure time.

    Extremes, peaks and crossings are those of the spline through the outputs, see `finer`. There is one peak
    between each upcrossing of the mean and the next. A Weibull distribution, with shape and
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
    dense = finer(values)
    upward, downward = peaks(dense - mean), peaks(mean - dense)
    crossed = upcrossings(dense - mean)
    apart = float(time[-1] - time[0]) / (len(dense) - 1)  # s
    period = float(crossed[-1] - crossed[0]) * apart / len(upward) if len(upward) else math.nan
    return Statistics(
        mean,
        deviation,
        period,
        float(dense.max()),
        mean + _most_probable(upward, exposure / period),
        float(dense.min()),
        mean - _most_probable(downward, exposure / period),
    )


def finer(values: FloatArray) -> FloatArray:
    """Outputs and values between them, (16 (n - 1) + 1,), by a spline of fifth degree through the outputs.

    The spline exceeds outputs at most as a sine does. Constant outputs, five outputs or fewer, and outputs of
    which some are missing, are interpolated linearly.

    Parameters
    ----------
    values : (n,) outputs at equal intervals, in any unit.
    """
    from scipy.interpolate import make_interp_spline

    outputs = np.arange(len(values))
    places = np.arange(BETWEEN * (len(values) - 1) + 1) / BETWEEN
    straight = not np.isfinite(values).all() or np.ptp(values) <= SAME * np.abs(values).max()
    if straight or len(values) <= DEGREE:
        return np.asarray(np.interp(places, outputs, values))
    made: FloatArray = make_interp_spline(outputs, values, DEGREE)(places)
    for end in (slice(0, ENDS * BETWEEN), slice(-ENDS * BETWEEN, None)):
        made[end] = np.interp(places[end], outputs, values)
    made = np.minimum(made, _highest(values))
    made = np.maximum(made, -_highest(-values))
    made[::BETWEEN] = values
    return made


def _highest(values: FloatArray) -> FloatArray:
    """Limit of values between outputs: they exceed outputs as a sine with four outputs in a period does.

    Impulses between outputs would otherwise make the spline oscillate. The limit is relative to the second
    difference of the outputs on both sides, of which a sine has the same sign. Beside a sudden change, such
    as the failure of a cylinder, the signs differ, and nothing exceeds the outputs.
    """
    above = np.zeros_like(values)
    above[1:-1] = np.maximum(-np.diff(values, 2), 0.0)
    of = np.maximum(values[:-1], values[1:]) + EXCESS * np.minimum(above[:-1], above[1:])
    return np.append(np.repeat(of, BETWEEN), values[-1])


def extremes(values: FloatArray) -> FloatArray:
    """Smallest and largest value of k records between and at outputs, (2, k).

    Parameters
    ----------
    values : (k, n) outputs at equal intervals, in any unit.
    """
    dense = (finer(one) for one in values)
    return np.array([(one.min(), one.max()) for one in dense]).T


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


def gumbel(largest: ArrayLike, longer: float = 1.0) -> Gumbel:
    """The Gumbel distribution of largest values, one per seed, by maximum likelihood.

    Parameters
    ----------
    largest : (seeds,) largest values, in their unit.
    longer : duration of the further seas of the fractile, divided by that of the seas (1).

    References
    ----------
    Gumbel 1958, Statistics of Extremes.
    """
    values: Any = np.asarray(largest, float)
    if np.ptp(values) <= SAME * np.abs(values).max():  # the sea does not change the quantity
        return Gumbel(float(values.mean()), 0.0, float(values.max()), 0.0)
    mode, scale = (float(of[0]) for of in fitted(values[None]))
    fractile = mode + scales_above_mode(values.size, NOT_EXCEEDED, longer) * scale
    mode, scale = corrected(mode, scale, values.size)
    return Gumbel(mode, scale, fractile, scale * error_of(0.0, values.size))
