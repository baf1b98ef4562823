"""Demand of a limit in a sea, from runs with several seeds, which nine in ten intervals do not exceed."""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.statistics import FEWEST_SEEDS, NOT_EXCEEDED, gumbel
from riserstudy.errors import InputError

FloatArray = NDArray[np.float64]
ALIKE = 1e-9  # relative spread of seeds that counts as rounding
SAMPLES = 20_000  # drawn sets of seeds: they give the share of runs below a demand within 0.1 %
MOST = 100  # number of seeds from which on errors of the fit are inversely proportional to this number
STEPS = 30  # of Newton's iteration for the scale of a distribution


class Demand(NamedTuple):
    """The demand of a limit, in the unit of its output."""

    value: float  # value that nine in ten intervals do not exceed
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
    above_mode = math.log(runs) - math.log(-math.log(NOT_EXCEEDED))  # in units of the scale
    share = 1.0 + 6.0 / math.pi**2 * (1.0 - np.euler_gamma + above_mode) ** 2
    deviation = found.scale * math.sqrt(share / len(values))
    value = sign * (found.mode + above_mode * found.scale)
    return Demand(float(value), float(deviation), found.scale)


def demand_of_next_run(values: FloatArray) -> float:
    """Value that the extreme of another run does not exceed in nine of ten cases, from those of the seeds.

    A distribution that is fitted to few seeds has errors. Of five seeds, its own fractile of 90 % is exceeded
    by 17 % of further runs, on average over the seeds. The value is therefore so many scales above the mode
    that the average is 10 %. For a Gumbel distribution, this number of scales depends on the number of seeds
    alone.

    Parameters
    ----------
    values : (n,) largest values of runs with n seeds, in the unit of their output.

    References
    ----------
    Lawless 2003, Statistical Models and Methods for Lifetime Data, chapter 5: pivotal quantities of location
    and scale, and prediction by them.
    """
    known = demand(values, "largest", 1.0)
    if not known.scale > 0.0:
        return known.value
    exact = -math.log(-math.log(NOT_EXCEEDED))
    few = min(len(values), MOST)
    above = exact + (_scales_above_mode(few) - exact) * few / len(values)
    return gumbel(values).mode + above * known.scale


@cache
def _scales_above_mode(seeds: int) -> float:
    """Scales above the mode of a fitted distribution that 10 % of further runs exceed on average."""
    from scipy.optimize import brentq

    mode, scale = _fitted(np.random.default_rng(0).gumbel(size=(SAMPLES, seeds)))

    def too_few(above: float) -> float:
        return NOT_EXCEEDED - float(np.exp(-np.exp(-mode - above * scale)).mean())

    return float(brentq(too_few, 1.0, 100.0))


def _fitted(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Modes and scales, (k,), of Gumbel distributions by maximum likelihood; values (k, seeds)."""
    low = values.min(axis=1, keepdims=True)
    above = values - low
    mean, scale = above.mean(axis=1), above.std(axis=1)
    for _ in range(STEPS):
        weight = np.exp(-above / scale[:, None])
        total = weight.sum(axis=1)
        first, second = ((above**power * weight).sum(axis=1) / total for power in (1, 2))
        slope = 1.0 + (second - first**2) / scale**2
        scale = np.maximum(scale - (scale - mean + first) / slope, 0.1 * scale)
    return low[:, 0] - scale * np.log(np.exp(-above / scale[:, None]).mean(axis=1)), scale
