"""Generalised Pareto distributions of peaks over a threshold: a fit, and distributions that may be true.

A band from fits to samples of one fitted distribution is too low, because a scale or a shape that is too
small by chance makes the samples too small as well. The distributions that may be true are therefore those
with which the same random numbers give the mean and the shape of the peaks.

References
----------
Hosking and Wallis 1987, Technometrics 29: L-moments. Hannig 2009, Statistica Sinica 19: generalised fiducial
inference.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from riserstudy.records.arrays import FloatArray

# range of the shape for seas and responses
SHAPES = (-0.5, 0.5)
TRIED = 11  # number of shapes between which the shape of a drawn sample is interpolated


class Pareto(NamedTuple):
    """Scales, in the unit of the peaks, and shapes (1)."""

    scale: FloatArray
    shape: FloatArray

    def over(self, exceeded: ArrayLike) -> FloatArray:
        """Excess over the threshold that is exceeded with a probability."""
        reduced, shape = -np.log(exceeded), np.where(self.shape == 0.0, 1.0, self.shape)
        over = np.where(self.shape == 0.0, reduced, np.expm1(shape * reduced) / shape)
        return np.asarray(self.scale * over)


def fitted(over: FloatArray) -> Pareto:
    """The distribution of peaks (n,) minus their threshold by L-moments."""
    mean, shape = _moments(over)
    shape = np.clip(shape, *SHAPES)
    return Pareto(mean * (1.0 - shape), shape)


def possible(over: FloatArray, draw: np.random.Generator, count: int) -> Pareto:
    """Distributions, (count,), that peaks (n,) minus their threshold may have."""
    mean, shape = _moments(over)
    chance = draw.uniform(size=(count, len(over)))
    shapes = np.linspace(*SHAPES, TRIED)
    means, found = np.array([_moments(Pareto(np.ones(1), one).over(chance)) for one in shapes]).swapaxes(0, 1)
    found = np.maximum.accumulate(found)
    after = np.clip((found < shape).sum(axis=0), 1, TRIED - 1)
    each = np.arange(count)
    below, above = found[after - 1, each], found[after, each]
    share = np.clip((shape - below) / np.maximum(above - below, 1e-12), 0.0, 1.0)
    drawn = means[after - 1, each] * (1.0 - share) + means[after, each] * share
    return Pareto(mean / drawn, shapes[after - 1] * (1.0 - share) + shapes[after] * share)


def _moments(over: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean, and shape by L-moments, over the last axis."""
    from scipy.stats import lmoment

    mean, second = lmoment(over, order=[1, 2], axis=-1)
    return mean, 2.0 - mean / second
