"""Bands of the share of workable hours, for a mean year and for future years, from few years of record.

Yearly shares, transformed to normal numbers by the arcsine of their root, have an unknown mean and standard
deviation, and persistence. They are fractional Gaussian noise with a Hurst exponent, which cannot be
estimated from a few years. For a given exponent, the error of the best linear prediction of future years,
divided by the standard deviation of the recorded years, follows Student's t distribution.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.records.arrays import FloatArray
from riserstudy.seas.years import Year
from riserstudy.study.persistence import PERSISTENCE

DRAWS = 20_000
BLOCK = 2_000  # number of draws at a time
BAND = (0.05, 0.95)
# probabilities of normal numbers, whose mean represents many years
NODES = (np.arange(64) + 0.5) / 64


class Band(NamedTuple):
    """The share of the record, and the band of nine in ten predictions; NaN if years give no deviation."""

    share: float
    low: float
    high: float


def band(years: Sequence[Year], persistence: float = PERSISTENCE) -> Band:
    """The band of the mean over very many years.

    Parameters
    ----------
    years : years of record.
    persistence : Hurst exponent of their shares; 0.5: years do not depend on one another.
    """
    return _predicted(years, None, persistence)


def band_of_next(years: Sequence[Year], count: int, persistence: float = PERSISTENCE) -> Band:
    """The band of the mean of ``count`` years after the last year of record.

    ``persistence``: Hurst exponent of their shares; 0.5: years do not depend on one another.

    References
    ----------
    Goldberger 1962, J. Am. Stat. Assoc. 57: best linear prediction. Anscombe 1948, Biometrika 35: the
    arcsine. Mandelbrot and Van Ness 1968, SIAM Review 10: fractional Gaussian noise.
    """
    return _predicted(years, count, persistence)


def covariance(lags: FloatArray, persistence: float) -> FloatArray:
    """Covariance of fractional Gaussian noise with standard deviation 1, over lags in years."""
    power = 2.0 * persistence
    at = np.abs(lags)
    found: FloatArray = 0.5 * ((at + 1.0) ** power - 2.0 * at**power + np.abs(at - 1.0) ** power)
    return found


class _Known(NamedTuple):
    """Properties of other years that follow from the years of record."""

    mean: float  # best linear estimate of the transformed shares
    mean_spread: float  # standard error of the mean, in standard deviations of a year
    deviation: float  # standard deviation of a year, from the unbiased estimate of its square
    freedom: int
    to_come: FloatArray  # (count,) best linear prediction
    # (count, count) root of the covariance of its errors, in standard deviations of a year
    root: FloatArray


def _predicted(years: Sequence[Year], count: int | None, persistence: float) -> Band:
    rows = sum(year.rows for year in years)
    share = sum(year.workable for year in years) / rows
    shares = np.array([year.share for year in years])
    if np.ptp(shares) == 0.0:
        return Band(share, math.nan, math.nan)
    known = _known(shares, np.array([year.year for year in years]), count or 0, persistence)
    draw = np.random.default_rng(0)
    means = [_drawn(known, count, draw) for _ in range(DRAWS // BLOCK)]
    low, high = np.quantile(np.concatenate(means), BAND)
    return Band(share, float(low), float(high))


def _known(shares: FloatArray, at: NDArray[np.int_], count: int, persistence: float) -> _Known:
    """Estimates by generalised least squares."""
    values = np.arcsin(np.sqrt(shares))
    times = np.concatenate([at, at[-1] + 1 + np.arange(count)]).astype(float)
    whole = covariance(times[:, None] - times, persistence)
    n = len(shares)
    among, across, ahead = whole[:n, :n], whole[n:, :n], whole[n:, n:]
    solved = np.linalg.solve(among, np.column_stack([np.ones(n), values, across.T]))
    weight = float(solved[:, 0].sum())
    mean = float(solved[:, 1].sum()) / weight
    off = values - mean
    square = float(off @ (solved[:, 1] - mean * solved[:, 0])) / (n - 1)
    to_come = mean + solved[:, 2:].T @ off
    # share of the mean that the years of record do not represent
    lacking = 1.0 - across @ solved[:, 0]
    errors = ahead - across @ solved[:, 2:] + np.outer(lacking, lacking) / weight
    root = np.asarray(np.linalg.cholesky(errors)) if count else errors
    return _Known(mean, weight**-0.5, math.sqrt(square), n - 1, to_come, root)


def _drawn(known: _Known, count: int | None, draw: np.random.Generator) -> FloatArray:
    """Drawn shares of means, (BLOCK,)."""
    from scipy.special import ndtri

    deviation = known.deviation / np.sqrt(draw.chisquare(known.freedom, BLOCK) / known.freedom)
    if count is None:
        middle = known.mean + deviation * known.mean_spread * draw.standard_normal(BLOCK)
        values = middle[:, None] + deviation[:, None] * ndtri(NODES)
    else:
        noise = draw.standard_normal((BLOCK, count)) @ known.root.T
        values = known.to_come + deviation[:, None] * noise
    shares: FloatArray = np.sin(np.clip(values, 0.0, math.pi / 2.0)) ** 2
    means: FloatArray = shares.mean(axis=1)
    return means
