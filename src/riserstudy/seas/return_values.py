"""Return values for long return periods by two methods, each with a band.

By both methods, the return value for T years is exceeded in a year with a probability of 1 / T. Largest
values of years follow a Gumbel distribution. Peaks over a threshold, one per storm, follow a generalised
Pareto distribution and a Poisson process. Bands are from distributions that may be true, by the errors of
fits to samples of the same size.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.table import Cell, Table
from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray
from riserstudy.seas.peaks_over import fitted, possible
from riserstudy.seas.year_bands import BAND
from riserstudy.seas.years import WHOLE

DRAWS = 400
APART = 72.0  # smallest time between peaks of two storms (h)
PEAKS_A_YEAR = 6  # number of storms per year whose peaks are used
FEWEST_YEARS = 5


class ReturnValue(NamedTuple):
    """A return value, and the band that contains the true one in nine of ten cases."""

    value: float
    low: float
    high: float


def of_years(largest: FloatArray, years: float, seed: int = 0) -> ReturnValue:
    """Return value from the largest value of each year, (n,): exceeded with a probability of 1 / years.

    ``years``: return period, above 1.

    References
    ----------
    Gumbel 1958, Statistics of Extremes; fitted by L-moments, Hosking 1990, J. R. Stat. Soc. B 52.
    """
    value, drawn = drawn_of_years(largest, years, np.random.default_rng(seed), DRAWS)
    return ReturnValue(value, *_band(drawn))


def drawn_of_years(
    largest: FloatArray, years: float, draw: np.random.Generator, count: int
) -> tuple[float, FloatArray]:
    """Return value, and (count,) values that may be true.

    Errors of mode and scale, divided by the scale, are those of fits to samples with known mode and scale.

    References
    ----------
    Lawless 2003, Statistical Models and Methods for Lifetime Data, chapter 5: pivotal quantities.
    """
    mode, scale = _gumbel(largest)
    at = -math.log(-math.log(1.0 - 1.0 / years))  # of the reduced variate
    modes, scales = _gumbel(draw.gumbel(size=(count, len(largest))))
    return float(mode + scale * at), mode + scale * (at - modes) / scales


def of_peaks(
    peaks: FloatArray, threshold: float, recorded: float, years: float, seed: int = 0
) -> ReturnValue:
    """Return value from peaks over a threshold, (n,), in a recorded time (years).

    ``years``: return period, above 1; in a year, the value is exceeded with a probability of 1 / years.

    References
    ----------
    Davison and Smith 1990, J. R. Stat. Soc. B 52; fitted by L-moments, Hosking and Wallis 1987,
    Technometrics 29.
    """
    draw = np.random.default_rng(seed)
    value, drawn = drawn_of_peaks(peaks, threshold, recorded, years, draw, DRAWS)
    return ReturnValue(value, *_band(drawn))


def drawn_of_peaks(
    peaks: FloatArray, threshold: float, recorded: float, years: float, draw: np.random.Generator, count: int
) -> tuple[float, FloatArray]:
    """Return value, and (count,) values that may be true."""
    over = peaks - threshold
    # numbers of peaks above the value, and above the threshold, that records of this length have on average;
    # a year has none above the value with a probability of exp(-number / recorded) = 1 - 1 / years
    above, expected = -math.log1p(-1.0 / years) * recorded, draw.gamma(len(peaks) + 0.5, size=count)
    drawn = possible(over, draw, count).over(np.minimum(above / expected, 1.0))
    return threshold + float(fitted(over).over(min(above / len(peaks), 1.0))), threshold + drawn


def storms(
    time: NDArray[np.datetime64], values: FloatArray, recorded: float, a_year: float = PEAKS_A_YEAR
) -> tuple[FloatArray, float]:
    """Peaks, (n,), of the highest storms, and the threshold below them.

    Storms are separate if their peaks are at least 72 hours apart. Values may be missing (NaN).

    Parameters
    ----------
    recorded : time with values (years), without gaps.
    a_year : number of storms per recorded year.
    """
    hours = (time - time[0]) / np.timedelta64(1, "h")
    order = np.argsort(-np.nan_to_num(values, nan=-np.inf))
    wanted = max(4, round(a_year * recorded))
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
    """Results of both methods, one row per return period (years).

    Raises InputError when fewer than five years are nearly complete.

    Parameters
    ----------
    interval : time between rows (h).
    unit : unit of the values, for the headings.
    """
    known = np.isfinite(values)
    largest = np.array([np.nanmax(values[of]) for of in whole_years(time, known, interval)])
    recorded = float(known.sum()) * interval / 8766.0
    peaks, threshold = storms(time, values, recorded)
    rows: list[list[Cell]] = []
    for period in periods:
        each = (of_years(largest, period), of_peaks(peaks, threshold, recorded, period))
        rows.append([period, *(float(value) for one in each for value in one)])
    return Table([*COLUMNS], ["years", *[unit] * 6], rows)


def whole_years(
    time: NDArray[np.datetime64], known: NDArray[np.bool_], interval: float, values: str = "a value"
) -> list[NDArray[np.bool_]]:
    """Rows (n,) of each nearly complete year (interval: hours between rows); ``values``: of known rows.

    Raises InputError when there are fewer than five.
    """
    year = time.astype("datetime64[Y]")
    rows = [year == one for one in np.unique(year)]
    whole = [of for of in rows if int(known[of].sum()) * interval >= WHOLE * 8766.0]
    if len(whole) < FEWEST_YEARS:
        found = f"only {len(whole)} of {len(rows)} years have {values} in at least {WHOLE:.0%} of their hours"
        allowed = f"give a record with {FEWEST_YEARS} or more such years"
        raise InputError("RECORD", "time", found, allowed)
    return whole


COLUMNS = (
    "return period", "by years", "years from", "years to", "by storms", "storms from", "storms to",
)  # fmt: skip


def _gumbel(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mode and scale of a Gumbel distribution by L-moments, over the last axis."""
    from scipy.stats import lmoment

    mean, second = lmoment(values, order=[1, 2], axis=-1)
    scale = second / math.log(2.0)
    return mean - np.euler_gamma * scale, scale


def _band(drawn: FloatArray) -> tuple[float, float]:
    low, high = np.quantile(drawn, BAND)
    return float(low), float(high)
