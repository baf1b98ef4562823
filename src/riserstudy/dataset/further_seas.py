"""Value that nine further seas in ten do not exceed, from a Gumbel distribution that is fitted to some seas.

The further seas can be longer: the largest of r seas has the distribution F^r.

A distribution that is fitted to few seas has errors. Of five seas, its own fractile of 90 % is exceeded by
17 % of further seas instead of 10 %, on average. The value is therefore so many scales above the mode of the
distribution that the average is 10 %. This number of scales depends on the number of seas alone, because mode
and scale are fitted by maximum likelihood.

References
----------
Lawless 2003, Statistical Models and Methods for Lifetime Data, chapter 5: pivotal quantities of location and
scale.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from riserstudy.records.arrays import FloatArray

SAMPLES = 20_000  # drawn sets of seas, with which the share of further seas has an error of 0.1 %
MOST = 100  # number of seas from which on errors of the fit are inversely proportional to this number
STEPS = 30  # of Newton's iteration for the scale of a distribution


def scales_above_mode(seas: int, share: float, longer: float = 1.0) -> float:
    """Scales above the fitted mode that a ``share`` of further seas does not exceed.

    Parameters
    ----------
    seas : number of seas to which the distribution is fitted.
    longer : duration of a further sea divided by that of a fitted sea.
    """
    exact = math.log(longer) - math.log(-math.log(share))
    few = min(seas, MOST)
    return exact + (_of_few(few, share, longer) - exact) * few / seas


@cache
def _of_few(seas: int, share: float, longer: float) -> float:
    """The same, by drawn sets of seas."""
    from scipy.optimize import brentq

    mode, scale = drawn_fits(seas)

    def lacks(above: float) -> float:
        return share - float(np.exp(-longer * np.exp(-mode - above * scale)).mean())

    return float(brentq(lacks, -10.0, 1000.0))


@cache
def drawn_fits(seas: int) -> tuple[FloatArray, FloatArray]:
    """Modes and scales (1) of fits to drawn sets of seas, (k,), whose true mode is 0 and true scale 1."""
    return fitted(np.random.default_rng(0).gumbel(size=(SAMPLES, seas)))


def fitted(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Modes and scales, (k,), of Gumbel distributions by maximum likelihood; values (k, seas), same unit."""
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
