"""Demand of a limit in a sea, from runs of several seeds: what nine in ten intervals do not exceed."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.statistics import FEWEST_SEEDS, NOT_EXCEEDED, gumbel
from riserstudy.errors import InputError

FloatArray = NDArray[np.float64]
ALIKE = 1e-9  # spread of seeds, relative to the largest, that is rounding


class Demand(NamedTuple):
    """What is demanded of a limit, in the unit of its output."""

    value: float  # that nine intervals in ten do not exceed
    deviation: float  # its standard error for want of seeds; not a number of one seed
    scale: float  # of the Gumbel distribution from interval to interval; 0 of means, not a number of one seed


def check_seeds(seeds: int) -> None:
    """See that so many seeds tell a distribution, or one alone.

    Raises
    ------
    InputError
        Where they do not.
    """
    if seeds != 1 and seeds < FEWEST_SEEDS:
        allowed = f"allowed are 1, whose extremes are used directly, and {FEWEST_SEEDS} or more"
        raise InputError("--seeds", str(seeds), "too few for a distribution", allowed)


def demand(values: FloatArray, side: str, runs: float) -> Demand:
    """Demand in an interval that so many runs fit into, by the demands of runs of several seeds.

    Extremes of the seeds follow a Gumbel distribution F; that of r runs one after the other is F^r. Means
    have the mean of the seeds.

    Parameters
    ----------
    values : (n,) demands of runs of n seeds, in the unit of their output.
    runs : so many of them, one after the other, fit into the interval.

    References
    ----------
    Gumbel 1958, Statistics of Extremes; standard error by maximum likelihood.
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
    above_mode = math.log(runs) - math.log(-math.log(NOT_EXCEEDED))  # in scales
    share = 1.0 + 6.0 / math.pi**2 * (1.0 - np.euler_gamma + above_mode) ** 2
    deviation = found.scale * math.sqrt(share / len(values))
    value = sign * (found.mode + above_mode * found.scale)
    return Demand(float(value), float(deviation), found.scale)
