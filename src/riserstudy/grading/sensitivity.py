"""Inputs that decide a yes or no.

For samples over ranges and options, the measure is the correlation ratio: the share of the outcome's variance
between groups of equal input, corrected for chance (epsilon squared). Estimators for given data that use a
kernel or the rank of an input (delta, PAWN, RBD-FAST) have no meaning for options without an order. For a
full grid of interpretations, the measure is the total effect, which includes interactions.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from itertools import combinations
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

MOST_GROUPS = 8  # largest number of groups of a continuous input
A_GROUP = 4  # smallest number of samples in a group
WEAK = 0.5  # explained share of the variance below which a second input is searched
WORTH = 0.05  # smallest additional share of the variance for a second input to be named
# an input must exceed this share of results for shuffled outcomes
SHUFFLES, SURE, SEED = 200, 0.95, 0


class Deciding(NamedTuple):
    """Deciding inputs, the most important first, and the variance that each or all of them explain."""

    names: list[str]
    # share of the variance that the inputs of samples explain together, 0 if none exceeds chance; None for a
    # grid, and if the outcome does not vary
    explained: float | None = None
    # total effect of each input of a grid; empty for samples
    total_effects: Mapping[str, float] = {}


def deciding(outcome: xr.DataArray, about: xr.Dataset) -> Deciding:
    """Inputs that decide whether an outcome is a hit.

    Parameters
    ----------
    outcome : above zero for a hit, over ``sample`` and any other dimensions; NaN cells are excluded.
    about : dataset with the assumptions of each sample, as variables ``assumed_...`` with the path as
        long_name.
    """
    known, hits = _known_hits(outcome)
    if hits.all() or not hits.any():
        return Deciding([])
    if "sample" not in outcome.dims:
        return _of_a_grid(outcome)
    values = hits.astype(float)
    groups = {name: _groups(x[known]) for name, x in inputs(outcome, about).items()}
    groups = {name: group for name, group in groups.items() if group.max(initial=0) > 0}
    if not groups:
        return Deciding([])
    shuffled = np.random.default_rng(SEED).permutation
    outcomes = np.stack([values, *(shuffled(values) for _ in range(SHUFFLES))])
    for count in (1, 2):
        names, explained, chance = _best(outcomes, groups, count)
        if explained > np.quantile(chance, SURE):
            break
    else:
        return Deciding([], 0.0)
    if count == 1 and explained < WEAK:
        pair, together, _ = _best(outcomes[:1], groups, 2, containing=names[0])
        if together >= explained + WORTH:
            names, explained = pair, together
    return Deciding(names, explained)


def _known_hits(outcome: xr.DataArray) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Flags of the known cells of an outcome, flat, and flags of hits among these."""
    values = outcome.values.astype(float).ravel()
    known = ~np.isnan(values)
    return known, values[known] > 0.0


def _best(
    outcomes: NDArray[np.float64], groups: dict[str, NDArray[np.int64]], count: int, containing: str = ""
) -> tuple[list[str], float, NDArray[np.float64]]:
    """The one or two inputs that explain most of the first outcome, with ``containing`` first.

    It also returns their share, and the largest share that any inputs explain of each other outcome.

    Two inputs have coarse groups. With evenly spread samples, small cells contain few samples, which also
    agree in other inputs, and the effect of those would be attributed to the cell.
    """
    cells: dict[tuple[str, ...], NDArray[np.int64]] = {(n,): group for n, group in groups.items()}
    if count == 2:
        sides = max(2, min(4, math.isqrt(outcomes.shape[1] // 8)))
        coarse = {name: _coarser(group, sides) for name, group in groups.items()}
        cells = {
            (a, b): coarse[a] * (coarse[b].max() + 1) + coarse[b]
            for a, b in combinations(groups, 2)
            if containing in ("", a, b)
        }
    if not cells:
        return [], 0.0, np.zeros(len(outcomes) - 1)
    share = {names: correlation_ratio(outcomes, cell) for names, cell in cells.items()}
    best = max(share, key=lambda names: share[names][0])
    chance = np.max([of[1:] for of in share.values()], axis=0)
    return sorted(best, key=lambda name: name != containing), float(share[best][0]), chance


def _coarser(group: NDArray[np.int64], most: int) -> NDArray[np.int64]:
    count = int(group.max()) + 1
    coarse: NDArray[np.int64] = group * min(count, most) // count
    return coarse


def _of_a_grid(outcome: xr.DataArray) -> Deciding:
    """The dimensions whose total effect is at least half of the largest one."""
    effects = total_effects(outcome)
    largest = max(effects.values(), default=0.0)
    names = sorted(
        (name for name, effect in effects.items() if effect >= 0.5 * largest), key=lambda name: -effects[name]
    )
    return Deciding(names, total_effects=effects)


def total_effects(outcome: xr.DataArray) -> dict[str, float]:
    """Share of the variance that remains when all dimensions but one are known, for each."""
    values = (outcome > 0.0).astype(float).where(outcome.notnull())
    total = float(values.var())
    names = [str(dim) for dim in values.dims if total > 0]
    return {name: float(values.var(name).mean()) / total for name in names}


def shares_by_option(
    outcome: xr.DataArray, about: xr.Dataset, names: Iterable[str]
) -> dict[str, dict[str, float]]:
    """Share of hits of an outcome for each option, by input.

    Inputs with ranges or numbers, instead of named options, are excluded. Options whose numbers are equal,
    such as a pressure that is absolute or gauge, are named ones.

    Parameters
    ----------
    outcome, about : as in ``deciding``.
    names : names of the inputs.
    """
    varied, (known, true) = inputs(outcome, about), _known_hits(outcome)
    shares: dict[str, dict[str, float]] = {}
    for name in names:
        values = varied[name][known]
        options = list(dict.fromkeys(str(value) for value in values))
        numbers = numbers_of(np.array(options))
        if numbers is None or len(set(numbers.tolist())) < len(options):
            shares[name] = {o: float(true[values.astype(str) == o].mean()) for o in options}
    return shares


def inputs(outcome: xr.DataArray, about: xr.Dataset) -> dict[str, NDArray[np.generic]]:
    """Values of every input in each cell of the outcome, flat: dimensions and assumptions of samples."""
    varied: dict[str, xr.DataArray] = {}
    for dim in outcome.dims:
        name = str(dim)
        if name != "sample" and outcome.sizes[dim] > 1:
            varied[name] = outcome[name]
    if "sample" in outcome.dims:
        for label, values in about.data_vars.items():
            if str(label).startswith("assumed_"):
                varied[str(values.attrs.get("long_name", label))] = values
    return {
        name: values.broadcast_like(outcome).transpose(*outcome.dims).values.ravel()
        for name, values in varied.items()
    }


def correlation_ratio(values: NDArray[np.float64], group: NDArray[np.int64]) -> NDArray[np.float64]:
    """Share of the variance between groups, minus its expectation by chance; 0 to 1.

    Parameters
    ----------
    values : (..., n).
    group : (n,) group of each value, counted from 0.

    Returns
    -------
    (...), 0 if all values are equal or each value is a group.
    """
    n = values.shape[-1]
    around = values - values.mean(-1, keepdims=True)
    total = (around**2).sum(-1)
    members = np.equal.outer(group, np.unique(group)).astype(float)
    used = members.shape[1]
    if n <= used:
        return np.zeros_like(total)
    between = ((around @ members) ** 2 / members.sum(0)).sum(-1)
    within = total - between
    whole = np.where(total > 0.0, total, 1.0)
    ratio = 1.0 - within / (n - used) / (whole / (n - 1))
    return np.where(total > 0.0, np.maximum(ratio, 0.0), 0.0)


def _groups(values: NDArray[np.generic]) -> NDArray[np.int64]:
    """Group of each value: the option itself, or one of several equally filled bins for a range."""
    unique, group = np.unique(values, return_inverse=True)
    places: NDArray[np.int64] = np.arange(len(unique))
    numbers = numbers_of(unique)
    if len(unique) > MOST_GROUPS and numbers is not None:
        count = max(2, min(MOST_GROUPS, len(unique) // A_GROUP))
        places[np.argsort(numbers)] = np.arange(len(unique)) * count // len(unique)
    groups: NDArray[np.int64] = places[group]
    return groups


def numbers_of(values: NDArray[np.generic]) -> NDArray[np.float64] | None:
    """Numbers at the begin of values; None for options, which have no order."""
    try:
        return np.array([float(str(value).split()[0]) for value in values])
    except ValueError:
        return None
