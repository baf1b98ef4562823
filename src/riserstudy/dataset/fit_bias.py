"""Mean errors and scatter of Gumbel distributions that are fitted to the extremes of few seas.

By maximum likelihood, the scale of few values is too small: by 16 % on average for five values. Fractiles
above the mode are then too low, and are exceeded more often than stated. For a Gumbel distribution, errors of
mode and scale, divided by the true scale, depend on the number of values alone. They are therefore corrected
by their means over fits to drawn samples of the same size.

References
----------
Lawless 2003, Statistical Models and Methods for Lifetime Data, chapter 5: pivotal quantities of location and
scale.
"""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

import numpy as np

from riserstudy.dataset.further_seas import MOST, drawn_fits
from riserstudy.records.arrays import FloatArray


class Bias(NamedTuple):
    """Errors of fits by maximum likelihood to a number of values whose mode is 0 and whose scale is 1."""

    mode: float  # mean mode
    scale: float  # mean scale
    variance: FloatArray  # (2, 2) covariance of mode and scale after their correction


def corrected(mode: float, scale: float, count: int) -> tuple[float, float]:
    """Mode and scale of a fit to ``count`` values, without their mean error, in their unit."""
    bias = bias_of(count)
    true = scale / bias.scale
    return mode - bias.mode * true, true


def error_of(above: float, count: int) -> float:
    """Standard error of a fractile, so many scales above the mode, of ``count`` values; in scales (1)."""
    at = np.array([1.0, above])
    return math.sqrt(float(at @ bias_of(count).variance @ at))


@cache
def ends_of_band(above: float, count: int, share: float) -> tuple[float, float]:
    """Ends of a band around a fractile of ``count`` values, below and above it, in its standard errors.

    The band contains the true fractile in a ``share`` of cases. For few values it is far longer upwards: the
    true fractile, minus the fitted mode and divided by the fitted scale, is distributed like Student's t.

    Parameters
    ----------
    above : scales of the fractile above the mode.
    """
    few = min(count, MOST)
    modes, scales = drawn_fits(few)
    bias, outside = bias_of(few), 0.5 * (1.0 - share)
    low, high = np.quantile((above - modes) / scales, [outside, 1.0 - outside])
    each = [(bias.mode + bias.scale * float(end) - above) / error_of(above, few) for end in (low, high)]
    return -each[0], each[1]


def possible(above: float, count: int, draw: np.random.Generator) -> tuple[float, float]:
    """A change of a corrected fractile, in scales, and a factor (1) of the scale, which may make them true.

    By the distribution of errors of fits to ``count`` values. Both belong to one fit: where the scale is too
    small, so is a fractile above the mode.

    Parameters
    ----------
    above : scales of the fractile above the mode.
    """
    few = min(count, MOST)
    modes, scales = drawn_fits(few)
    bias, k = bias_of(few), draw.integers(len(modes))
    share = math.sqrt(few / count)
    change = bias.mode + bias.scale * float((above - modes[k]) / scales[k]) - above
    return share * change, 1.0 + share * (bias.scale / float(scales[k]) - 1.0)


def error_of_scale(count: int) -> float:
    """Relative standard error (1) of the scale of a fit to ``count`` values."""
    return math.sqrt(float(bias_of(count).variance[1, 1]))


@cache
def bias_of(count: int) -> Bias:
    """Errors of fits to ``count`` values; for many values, they are inversely proportional to this number."""
    if count > MOST:
        most, share = bias_of(MOST), MOST / count
        return Bias(share * most.mode, 1.0 + share * (most.scale - 1.0), share * most.variance)
    modes, scales = drawn_fits(count)
    mode, scale = float(modes.mean()), float(scales.mean())
    return Bias(mode, scale, np.cov(modes - mode * scales / scale, scales / scale))
