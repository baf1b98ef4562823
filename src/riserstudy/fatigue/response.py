r"""Damage per year at any sea state within a grid, by monotone cubic interpolation of its fourth root.

.. math:: \dot D^{1/4}(x) = L(x) + \sum_a \left(H_a(x) - L(x)\right)

Here L is the multilinear interpolation, and :math:`H_a` the same with a monotone cubic function along the
axis a instead of a linear one. Damage increases about as the third to fifth power of the wave height, so
its fourth root is nearly linear. Near a resonance, its slope changes with the period. In 300 drawn studies
with a resonance, linear interpolation alone gave a damage that was 5 % too small in the median, monotone
cubic functions 0.5 %.

The error of the interpolation is estimated by omission of every second value of each axis: a third of the
difference remains. The difference depends on the values that are omitted, and near a resonance it may be
small by chance. The larger difference by both choices therefore counts in each sea state, and differences
of sea states do not cancel.

References
----------
Fritsch and Butland 1984, SIAM J. Sci. Stat. Comput. 5: slopes of monotone cubic functions.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.records.arrays import FloatArray

POWER = 0.25
# factor by which halving the distance of values reduces the error of interpolation, at least
ORDER = 4.0
MANY = 2000  # number of sea states that are summed together


class Response(NamedTuple):
    """Damage per year over axes: increasing values by axis, and rates over (axes..., places...), 1/year."""

    grid: dict[str, FloatArray]
    rates: FloatArray

    def sums(self, values: Mapping[str, FloatArray], shares: FloatArray) -> FloatArray:
        """Damage per year of each sea state, weighted by its share (1), (states, places...)."""
        count = len(self.grid)
        root = self.rates**POWER
        found = np.zeros((len(shares), *root.shape[count:]))
        sides = [_sides(places, values[axis]) for axis, places in self.grid.items()]
        along = [_slopes(places, root, k) for k, places in enumerate(self.grid.values())]
        for corner in product((0, 1), repeat=count):
            index = tuple(side.number[up] for side, up in zip(sides, corner, strict=True))
            linear = [side.linear[up] for side, up in zip(sides, corner, strict=True)]
            weight = np.prod(linear, axis=0)
            for k, (side, up, slopes) in enumerate(zip(sides, corner, along, strict=True)):
                others = np.prod(np.delete(linear, k, axis=0), axis=0)
                weight = weight + others * (side.cubic[up] - side.linear[up])
                found += _over_places(others * side.of_slope[up], found) * slopes[index]
            found += _over_places(weight, found) * root[index]
        # with several axes, the sum of cubic functions may be below zero next to zero
        return np.asarray(_over_places(shares, found) * np.maximum(found, 0.0) ** (1.0 / POWER))

    def thinned(self, axis: str) -> list[Response]:
        """Copies without every second value of an axis, from the second or the third on, except its ends.

        Empty for fewer than three values.
        """
        count = len(self.grid[axis])
        along = list(self.grid).index(axis)
        found = []
        for first in (1, 2) if count >= 3 else ():
            kept = np.delete(np.arange(count), np.arange(first, count - 1, 2))
            places = self.grid[axis][kept]
            found.append(Response(self.grid | {axis: places}, self.rates.take(kept, axis=along)))
        return found

    def between(self, axis: str, values: FloatArray) -> NDArray[np.bool_]:
        """Whether each of some values of an axis, (states,), is not one of the simulated values."""
        there = np.isclose(values[:, None], self.grid[axis], rtol=1e-9, atol=0.0)
        return np.asarray(~there.any(axis=1))


class _Sides(NamedTuple):
    """Values of an axis between a simulated value, 0, and the next, 1: (states,) for each of these."""

    number: tuple[NDArray[np.int64], NDArray[np.int64]]
    linear: tuple[FloatArray, FloatArray]  # weights of a linear function
    cubic: tuple[FloatArray, FloatArray]  # weights of a cubic function
    of_slope: tuple[FloatArray, FloatArray]  # weights of its slopes, in the unit of the axis


def _sides(places: FloatArray, values: FloatArray) -> _Sides:
    last = len(places) - 1
    below = np.clip(np.searchsorted(places, values, "right") - 1, 0, max(last - 1, 0))
    width = np.diff(places, append=places[-1] + 1.0)[below]
    t = np.clip((values - places[below]) / width, 0.0, 1.0)
    up = t**2 * (3.0 - 2.0 * t)
    slopes = width * t * (1.0 - t) ** 2, -width * t**2 * (1.0 - t)
    return _Sides((below, np.minimum(below + 1, last)), (1.0 - t, t), (1.0 - up, up), slopes)


def _slopes(places: FloatArray, root: FloatArray, axis: int) -> FloatArray:
    """Slopes of monotone cubic functions along an axis; zero for an axis with one value."""
    from scipy.interpolate import PchipInterpolator

    if len(places) < 2:
        return np.zeros_like(root)
    return np.asarray(PchipInterpolator(places, root, axis=axis).derivative()(places))


def _over_places(of_states: FloatArray, like: FloatArray) -> FloatArray:
    """Numbers of sea states, (states,), with the dimensions of places, of length one."""
    return of_states.reshape(-1, *[1] * (like.ndim - 1))


def in_parts(response: Response, values: Mapping[str, FloatArray], shares: FloatArray) -> FloatArray:
    """Damage per year of all sea states together, (places...), computed in blocks to limit memory."""
    total = np.zeros(response.rates.shape[len(response.grid) :])
    for first in range(0, len(shares), MANY):
        part = slice(first, first + MANY)
        total += response.sums({a: v[part] for a, v in values.items()}, shares[part]).sum(axis=0)
    return total
