"""Demand of a limit in a sea, from runs with several seeds: what nine in ten intervals do not exceed.

The demand is an estimate without bias, as shares of time require: sea states of which it is too large are as
frequent as those of which it is too small. A single demand is therefore exceeded by more than one in ten
intervals on average, because a demand that is too small adds more than an equally large one takes away.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from riserstudy.dataset.fit_bias import bias_of, ends_of_band, error_of
from riserstudy.dataset.further_seas import MOST, drawn_fits
from riserstudy.dataset.statistics import FEWEST_SEEDS, NOT_EXCEEDED, gumbel
from riserstudy.errors import InputError
from riserstudy.records.arrays import FloatArray

ALIKE = 1e-9  # relative spread of seeds that counts as rounding
BAND = 0.9  # share of cases in which the band of a demand contains its true value


class Demand(NamedTuple):
    """The demand of a limit, in the unit of its output."""

    value: float  # estimate, without bias, of the value that nine in ten intervals do not exceed
    deviation: float  # its standard error due to the number of seeds; NaN for one seed
    scale: float  # scale of the Gumbel distribution of intervals; 0 for means, NaN for one seed


def check_seeds(seeds: int) -> None:
    """Check that the number of seeds is one, or sufficient for a distribution.

    Raises InputError if it is neither.
    """
    if seeds != 1 and seeds < FEWEST_SEEDS:
        allowed = f"give {FEWEST_SEEDS} or more, or 1 to use the extremes of one run directly"
        found = f"{seeds} runs are too few for a distribution of extremes"
        raise InputError("command line", "--seeds", found, allowed)


def demand(values: FloatArray, side: str, runs: float) -> Demand:
    """Demand in an interval as long as ``runs`` runs, from the demands of runs with several seeds.

    Extremes of the seeds follow a Gumbel distribution F. For r successive runs, the distribution is F^r. For
    means, the result is the mean of the seeds.

    Parameters
    ----------
    values : (n,) demands of runs with n seeds, in the unit of their output.
    runs : length of the interval divided by the length of a run.

    References
    ----------
    Gumbel 1958, Statistics of Extremes; fitted by maximum likelihood without its bias for few values.
    """
    if len(values) == 1:
        return Demand(float(values[0]), math.nan, math.nan)
    if side == "mean":
        deviation = float(values.std(ddof=1)) / math.sqrt(len(values))
        return Demand(float(values.mean()), deviation, 0.0)
    sign = -1.0 if side == "smallest" else 1.0
    largest = sign * values
    if np.isnan(values).any() or np.ptp(largest) <= ALIKE * abs(largest).max():
        return Demand(float(sign * largest.max()), 0.0, 0.0)
    found = gumbel(largest)
    above_mode = scales_of(runs)
    deviation = found.scale * error_of(above_mode, len(values))
    return Demand(sign * (found.mode + above_mode * found.scale), deviation, found.scale)


def scales_of(runs: float) -> float:
    """Scales (1) of a demand above the mode of runs, in an interval as long as ``runs`` runs (1)."""
    return math.log(runs) - math.log(-math.log(NOT_EXCEEDED))


def exceeded_on_average(runs: float, seeds: int) -> float:
    """Share of intervals whose extreme exceeds the demand from some seeds, on average over such demands (1).

    More than one in ten. For many seeds, the excess is inversely proportional to their number.

    Parameters
    ----------
    runs : length of the interval divided by the length of a run (1).
    """
    few = min(seeds, MOST)
    modes, scales = drawn_fits(few)
    bias = bias_of(few)
    demands = modes + (scales_of(runs) - bias.mode) * scales / bias.scale
    share = float(-np.expm1(-runs * np.exp(-demands)).mean())
    return 1.0 - NOT_EXCEEDED + (share - 1.0 + NOT_EXCEEDED) * few / seeds


def ends(side: str, runs: float, seeds: int) -> tuple[float, float]:
    """Ends of the band of a demand: towards worse and better demands, in its standard errors.

    For one seed, the standard error is not known, and the band has no width.

    Parameters
    ----------
    runs : length of the interval divided by the length of a run (1).
    """
    from scipy.special import stdtrit

    if seeds == 1:
        return 0.0, 0.0
    if side == "mean":
        student = float(stdtrit(seeds - 1, 0.5 * (1.0 + BAND)))
        return student, student
    better, worse = ends_of_band(scales_of(runs), seeds, BAND)
    return worse, better
