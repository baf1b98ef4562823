"""Values that are exceeded once in many years, by two methods, each with a band: never one number alone.

Largest values of years follow a Gumbel distribution. Peaks over a threshold, one a storm, follow a
generalised Pareto distribution and come as a Poisson process. Bands are those of fits to as
much drawn from either.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from riserstudy.dataset.table import Cell, Table
from riserstudy.errors import InputError
from riserstudy.seas.year_bands import BAND
from riserstudy.seas.years import WHOLE

FloatArray = NDArray[np.float64]
DRAWS = 400
APART = 72.0  # h between peaks of two storms
PEAKS_A_YEAR = 6  # storms a year whose peaks count
FEWEST_YEARS = 5
SHAPES = (-0.5, 0.5)  # of the generalised Pareto distribution: what seas and responses have


class ReturnValue(NamedTuple):
    """What is exceeded once in so many years, and where nine in ten of such fits lie."""

    value: float
    low: float
    high: float


def of_years(largest: FloatArray, years: float, seed: int = 0) -> ReturnValue:
    """By the largest value of each year, (n,): exceeded with a chance of 1 / years by their distribution.

    Parameters
    ----------
    years : return period, above 1.

    References
    ----------
    Gumbel 1958, Statistics of Extremes; fitted by L-moments, Hosking 1990, J. R. Stat. Soc. B 52.
    """
    value, fitted = refits_of_years(largest, years, np.random.default_rng(seed), DRAWS)
    return ReturnValue(value, *_band(fitted))


def refits_of_years(
    largest: FloatArray, years: float, draw: np.random.Generator, count: int
) -> tuple[float, FloatArray]:
    """What is exceeded once in so many years, and (count,) what fits to as much drawn from the fit give."""
    mode, scale = _gumbel(largest)
    at = -math.log(-math.log(1.0 - 1.0 / years))  # of the reduced variate
    modes, scales = _gumbel(draw.gumbel(mode, scale, (count, len(largest))))
    return float(mode + scale * at), modes + scales * at


def of_peaks(
    peaks: FloatArray, threshold: float, recorded: float, years: float, seed: int = 0
) -> ReturnValue:
    """By peaks over a threshold, (n,), in a time of record (years).

    References
    ----------
    Davison and Smith 1990, J. R. Stat. Soc. B 52; fitted by L-moments, Hosking and Wallis 1987,
    Technometrics 29.
    """
    draw = np.random.default_rng(seed)
    value, fitted = refits_of_peaks(peaks, threshold, recorded, years, draw, DRAWS)
    return ReturnValue(value, *_band(fitted))


def refits_of_peaks(
    peaks: FloatArray,
    threshold: float,
    recorded: float,
    years: float,
    draw: np.random.Generator,
    count: int,
) -> tuple[float, FloatArray]:
    """What is exceeded once in so many years, and (count,) what fits to as much drawn from the fit give."""
    scale, shape = _pareto(peaks - threshold)
    once = recorded / (len(peaks) * years)  # the chance of a peak that is exceeded once in the time
    drawn = _over(scale, shape, draw.uniform(size=(count, len(peaks))))
    counts = np.maximum(draw.poisson(len(peaks), count), 1)
    fitted = _over(*_pareto(drawn), once * len(peaks) / counts)
    return threshold + float(_over(scale, shape, once)), threshold + fitted


def storms(
    time: NDArray[np.datetime64], values: FloatArray, a_year: float
) -> tuple[FloatArray, float]:
    """Peaks, (n,), of so many of the highest storms a year, and the threshold below them.

    Storms are apart where 72 hours lie between their peaks. Values may be absent (not a number).
    """
    hours = (time - time[0]) / np.timedelta64(1, "h")
    order = np.argsort(-np.nan_to_num(values, nan=-np.inf))
    wanted = max(4, round(a_year * (hours[-1] - hours[0]) / 8766.0))
    chosen: list[int] = []
    for k in order[np.isfinite(values[order])]:
        if all(abs(hours[k] - hours[other]) >= APART for other in chosen):
            chosen.append(int(k))
        if len(chosen) > wanted:
            break
    found = values[chosen]
    return found[:-1], float(found[-1])


def return_values(
    time: NDArray[np.datetime64],
    values: FloatArray,
    interval: float,
    periods: Sequence[float],
    unit: str = "",
) -> Table:
    """Both methods side by side, a row a return period (years).

    Parameters
    ----------
    interval : hours between rows.
    unit : of the values, for the heads.

    Raises
    ------
    InputError
        When fewer than five years are recorded nearly whole.
    """
    known = np.isfinite(values)
    largest = np.array([np.nanmax(values[of]) for of in whole_years(time, known, interval)])
    peaks, threshold = storms(time, values, PEAKS_A_YEAR)
    recorded = known.sum() * interval / 8766.0
    rows: list[list[Cell]] = []
    for period in periods:
        each = (of_years(largest, period), of_peaks(peaks, threshold, recorded, period))
        rows.append([period, *(float(value) for one in each for value in one)])
    return Table([*COLUMNS], ["years", *[unit] * 6], rows)


def whole_years(
    time: NDArray[np.datetime64], known: NDArray[np.bool_], interval: float
) -> list[NDArray[np.bool_]]:
    """Rows (n,) of each year that is recorded nearly whole (interval: hours between rows).

    Raises
    ------
    InputError
        When these are fewer than five.
    """
    year = time.astype("datetime64[Y]").astype(int) + 1970
    rows = [year == one for one in np.unique(year)]
    whole = [of for of in rows if int(known[of].sum()) * interval >= WHOLE * 8766.0]
    if len(whole) < FEWEST_YEARS:
        found = f"{len(whole)} years recorded nearly whole"
        raise InputError("RECORD", "time", found, f"return values need {FEWEST_YEARS}")
    return whole


COLUMNS = (
    "return period", "by years", "years from", "years to", "by storms", "storms from", "storms to",
)  # fmt: skip


def _gumbel(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mode and scale by L-moments, over the last axis."""
    from scipy.stats import lmoment

    mean, second = lmoment(values, order=[1, 2], axis=-1)
    scale = second / math.log(2.0)
    return mean - np.euler_gamma * scale, scale


def _pareto(over: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Scale and shape by L-moments, over the last axis; the shape is kept between -0.5 and 0.5."""
    from scipy.stats import lmoment

    mean, second = lmoment(over, order=[1, 2], axis=-1)
    shape = np.clip(2.0 - mean / second, *SHAPES)
    return mean * (1.0 - shape), shape


def _over(scale: ArrayLike, shape: ArrayLike, exceeded: ArrayLike) -> FloatArray:
    """Excess over the threshold that is exceeded with a chance."""
    from scipy.stats import genpareto

    return np.asarray(genpareto.isf(exceeded, shape, scale=scale))


def _band(fitted: FloatArray) -> tuple[float, float]:
    low, high = np.quantile(fitted, BAND)
    return float(low), float(high)
