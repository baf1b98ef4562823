"""Search for the point of a unit cube at which a function is least.

Points all over the cube are tried, and the search continues from the best of them; in one dimension, it
continues from each minimum, so that all minima of equal size are found.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize, minimize_scalar

from riserstudy.study.sampling import sobol

MOST = 400  # evaluations per start
STARTS = 3  # the largest error has edges, onto which a simplex shrinks: it is restarted there
FIRST_STEP = 0.1  # as a share of a range
SPREAD = 16  # number of points that are tried first, for each dimension
SAME = 1e-3  # difference of minima that counts as none
APART = 0.01  # distance of points that count as different
SEED = 1

Shares = Sequence[float]


class Fit(NamedTuple):
    """Result of a search: shares of the ranges, the largest relative error, and number of evaluations.

    ``others``: shares of other values that fit equally well.
    """

    shares: list[float]
    miss: float
    looks: int
    others: tuple[list[float], ...] = ()


def search(miss: Callable[[Shares], float], start: Shares, most: int = MOST) -> Fit:
    """Find the point of the unit cube at which a function (here the largest error) is least.

    The function is first evaluated at the start and at points all over the cube. The search continues from
    the best of them; in one dimension, from each minimum.

    References
    ----------
    Nelder and Mead (1965); the simplex is restarted at the point onto which it has shrunk.
    """
    tried = [[*map(float, start)], *_spread(len(start), min(SPREAD * len(start), most))]
    misses = [miss(shares) for shares in tried]
    fits = [_descended(miss, Fit(*one, 0), most) for one in _minima(tried, misses)]
    best = min(fits, key=lambda fit: fit.miss)
    others: list[list[float]] = []
    for fit in sorted(fits, key=lambda fit: fit.shares):
        known = [best.shares, *others]
        if fit.miss <= best.miss + SAME and all(_distance(fit.shares, one) > APART for one in known):
            others.append(fit.shares)
    return best._replace(looks=len(tried) + sum(fit.looks for fit in fits), others=tuple(others))


def _spread(dimensions: int, count: int) -> list[list[float]]:
    """Return points all over the unit cube; in one dimension, evenly spaced."""
    if dimensions == 1:
        return [[float(x)] for x in np.linspace(0.0, 1.0, SPREAD)]
    return sobol(dimensions, count, SEED)


def _minima(tried: list[list[float]], misses: list[float]) -> list[tuple[list[float], float]]:
    """Return the best of the points tried; in one dimension, each point without a better neighbour."""
    order = sorted(range(len(tried)), key=lambda k: tried[k] if len(tried[0]) == 1 else misses[k])
    if len(tried[0]) > 1:
        return [(tried[order[0]], misses[order[0]])]
    row = [np.inf, *(misses[k] for k in order), np.inf]
    low = [k for n, k in enumerate(order) if row[n] > row[n + 1] <= row[n + 2]]
    return [(tried[k], misses[k]) for k in low or order[:1]]


def _distance(one: Shares, other: Shares) -> float:
    return float(np.abs(np.subtract(one, other)).max())


def _descended(miss: Callable[[Shares], float], best: Fit, most: int) -> Fit:
    """Return the minimum that is found from a point, with the number of evaluations.

    In one dimension it is between the neighbours of the point, else a simplex descends to it.
    """
    looks = 0
    if len(best.shares) == 1:  # between the neighbours of the point
        ends = np.clip(best.shares[0] + np.array([-1.0, 1.0]) / (SPREAD - 1), 0.0, 1.0)
        found = minimize_scalar(
            lambda x: miss([float(x)]),
            bounds=ends,
            method="bounded",
            options={"xatol": 1e-5, "maxiter": most},
        )
        tried = Fit([float(found.x)], float(found.fun), int(found.nfev))
        return tried if tried.miss < best.miss else best._replace(looks=tried.looks)
    for _ in range(STARTS):
        corner = np.array(best.shares)
        away = np.where(corner < 0.5, FIRST_STEP, -FIRST_STEP)
        simplex = np.vstack([corner, corner + np.diag(away)])
        minimum = minimize(
            miss,
            corner,
            method="Nelder-Mead",
            bounds=[(0.0, 1.0)] * len(corner),
            options={"maxfev": most, "initial_simplex": simplex, "xatol": 1e-4, "fatol": 1e-5},
        )
        looks += int(minimum.nfev)
        if minimum.fun >= best.miss:
            break
        best = Fit([float(x) for x in minimum.x], float(minimum.fun), 0)
    return best._replace(looks=looks)
