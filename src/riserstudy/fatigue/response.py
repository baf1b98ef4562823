r"""Damage per year at any sea state within a grid, by linear interpolation of the fourth root of damage.

.. math:: \dot D^{1/4}(x) = \sum_k w_k(x)\, \dot D_k^{1/4}

with the weights of a multilinear interpolation. Damage increases about as the third to fifth power of the
wave height, so its fourth root is nearly linear. The error of the interpolation is estimated by omission of
every second value of each axis: a third of the difference remains. The difference depends on the values that
are omitted, and near a resonance it may be small by chance. The larger difference by both choices therefore
counts in each sea state, and differences of sea states do not cancel.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
POWER = 0.25
# factor by which halving the distance of values reduces the error of linear interpolation
ORDER = 4.0
MANY = 2000  # number of sea states that are summed together


class Response(NamedTuple):
    """Damage per year over axes: increasing values by axis, and rates over (axes..., places...), 1/year."""

    grid: dict[str, Array]
    rates: Array

    def sums(self, values: Mapping[str, Array], shares: Array) -> Array:
        """Damage per year of each sea state, weighted by its share (1), (states, places...)."""
        count = len(self.grid)
        corners = np.zeros((len(shares), *self.rates.shape[count:]))
        sides = []
        for axis, places in self.grid.items():
            e = np.clip(np.searchsorted(places, values[axis], "right") - 1, 0, max(len(places) - 2, 0))
            width = np.diff(places, append=places[-1] + 1.0)[e]
            sides.append((e, np.clip((values[axis] - places[e]) / width, 0.0, 1.0)))
        for corner in product((0, 1), repeat=count):
            weight = np.ones(len(shares))
            index = []
            for (e, share), up, places in zip(sides, corner, self.grid.values(), strict=True):
                weight = weight * (share if up else 1.0 - share)
                index.append(np.minimum(e + up, len(places) - 1))
            some = weight > 0.0
            at = self.rates[tuple(k[some] for k in index)]
            corners[some] += weight[some].reshape(-1, *[1] * (at.ndim - 1)) * at**POWER
        return np.asarray(shares.reshape(-1, *[1] * (corners.ndim - 1)) * corners ** (1.0 / POWER))

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

    def between(self, axis: str, values: Array) -> NDArray[np.bool_]:
        """Whether each of some values of an axis, (states,), is not one of the simulated values."""
        there = np.isclose(values[:, None], self.grid[axis], rtol=1e-9, atol=0.0)
        return np.asarray(~there.any(axis=1))


def in_parts(response: Response, values: Mapping[str, Array], shares: Array) -> Array:
    """Damage per year of all sea states together, (places...), computed in blocks to limit memory."""
    total = np.zeros(response.rates.shape[len(response.grid) :])
    for first in range(0, len(shares), MANY):
        part = slice(first, first + MANY)
        total += response.sums({a: v[part] for a, v in values.items()}, shares[part]).sum(axis=0)
    return total
