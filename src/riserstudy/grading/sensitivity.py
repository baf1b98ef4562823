"""Which inputs decide a yes or no.

Over samples that mix ranges and options: correlation ratios, the share of the outcome's variance that
lies between groups of equal input, freed of what chance alone would give (epsilon squared). Estimators
for given data that rest on a kernel or on the rank of an input (delta, PAWN, RBD-FAST) have no meaning
for options without an order. Over a full grid of readings: total effects, which count interactions too.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from itertools import combinations
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

MOST_GROUPS = 8  # of a continuous input
A_GROUP = 4  # samples at least
WEAK = 0.5  # below this share of the variance, a second input is looked for
WORTH = 0.05  # of the variance, for a second input to be named
SHUFFLES, SURE, SEED = 200, 0.95, 0  # an input is named when it beats so many shuffled outcomes


class Deciding(NamedTuple):
    """Deciding inputs, the most important first, and how much each or all of them explain.

    Attributes
    ----------
    explained : share of the variance that samples' inputs explain together, 0 where none stands out from
        chance; None over a grid, and where nothing varies.
    total_effects : of each input over a grid; empty for samples.
    """

    names: list[str]
    explained: float | None = None
    total_effects: Mapping[str, float] = {}


def deciding(outcome: xr.DataArray, about: xr.Dataset) -> Deciding:
    """Inputs that decide whether an outcome is a hit.

    Parameters
    ----------
    outcome : above zero where it is one, over ``sample`` and any other dimensions; cells that are not a
        number are left out.
    about : holds what each sample assumed, as variables ``assumed_...`` with the path as long_name.
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
    """Which cells of an outcome are known, flat, and of these which are hits."""
    values = outcome.values.astype(float).ravel()
    known = ~np.isnan(values)
    return known, values[known] > 0.0


def _best(
    outcomes: NDArray[np.float64],
    groups: dict[str, NDArray[np.int64]],
    count: int,
    containing: str = "",
) -> tuple[list[str], float, NDArray[np.float64]]:
    """The one input or the two that explain most of the first outcome, the ``containing`` one first.

    Also their share, and the largest share that any explain of each of the other outcomes.

    Two inputs are laid out coarsely: evenly spread samples leave few in a cell, which then share what
    other inputs are, and the cell would be given credit for that.
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
    """The dimensions whose total effect is at least half of the largest."""
    effects = total_effects(outcome)
    largest = max(effects.values(), default=0.0)
    names = sorted(
        (name for name, effect in effects.items() if effect >= 0.5 * largest),
        key=lambda name: -effects[name],
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
    """Share of hits of an outcome under each option, by input.

    Inputs that are no named options, ranges and numbers, are left out.

    Parameters
    ----------
    outcome, about : as in ``deciding``.
    names : of the inputs.
    """
    varied, (known, true) = inputs(outcome, about), _known_hits(outcome)
    shares: dict[str, dict[str, float]] = {}
    for name in names:
        values = varied[name][known]
        options = list(dict.fromkeys(str(value) for value in values))
        if numbers_of(np.array(options)) is None:
            shares[name] = {o: float(true[values.astype(str) == o].mean()) for o in options}
    return shares


def inputs(outcome: xr.DataArray, about: xr.Dataset) -> dict[str, NDArray[np.generic]]:
    """Values of every input in each cell of the outcome, flat: dimensions and what samples assumed."""
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
    """Share of the variance between groups, less what chance gives; 0 to 1.

    Parameters
    ----------
    values : (..., n).
    group : (n,) that each belongs to, counted from 0.

    Returns
    -------
    (...), 0 where all values are alike or groups as many as values.
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
    """Group of each value: itself for options, one of several equally filled bins for a range."""
    unique, group = np.unique(values, return_inverse=True)
    places: NDArray[np.int64] = np.arange(len(unique))
    numbers = numbers_of(unique)
    if len(unique) > MOST_GROUPS and numbers is not None:
        count = max(2, min(MOST_GROUPS, len(unique) // A_GROUP))
        places[np.argsort(numbers)] = np.arange(len(unique)) * count // len(unique)
    groups: NDArray[np.int64] = places[group]
    return groups


def numbers_of(values: NDArray[np.generic]) -> NDArray[np.float64] | None:
    """Numbers that values begin with; None for options, which have no order."""
    try:
        return np.array([float(str(value).split()[0]) for value in values])
    except ValueError:
        return None
