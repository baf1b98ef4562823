"""Comparisons in the words of a claim, with one bound for each word, and a smallest difference.

A claim of a change is true if the change reaches the bound of its word. If the change is within the dead
band, the answer is "no difference"; otherwise the claim is false.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from riserstudy.grading.margin import Value, above, rising
from riserstudy.grading.word_of_size import Word


class Condition(NamedTuple):
    """A condition of a claim: its margin, above zero where it is met, and flags of no difference."""

    margin: xr.DataArray
    same: xr.DataArray


def more(value: Value, other: Value, word: Word) -> Condition:
    """Condition: a value exceeds another by at least the bound of a word."""
    difference = above(value, other)
    return Condition(difference - word.bound, abs(difference) < word.band)


def less(value: Value, other: Value, word: Word) -> Condition:
    """Condition: a value is below another by at least the bound of a word."""
    return more(other, value, word)


def alike(value: Value, other: Value, word: Word) -> Condition:
    """Condition: two values differ by at most the bound of a word."""
    return plain(word.bound - abs(above(value, other)))


def plain(margin: xr.DataArray) -> Condition:
    """A condition without a dead band, such as a bound in seconds."""
    return Condition(margin, xr.zeros_like(margin, bool))


def growing(values: xr.DataArray, axis: str, word: Word, sign: float = 1.0) -> Condition:
    """Condition: values increase (sign 1) or decrease (-1) along an axis by a word's bound, monotonically.

    The change is from the first to the last value; a step in the other direction counts if it exceeds the
    dead band.
    """
    first, last = (values.isel({axis: end}, drop=True) for end in (0, -1))
    whole = more(last, first, word) if sign > 0 else less(last, first, word)
    return all_of(whole, plain(rising(values, axis, sign) + word.band))


def more_on_the_whole(
    value: xr.DataArray, other: xr.DataArray, word: Word, axis: str, within: xr.DataArray | None = None
) -> Condition:
    """Condition: the mean along an axis exceeds another by the bound of a word, and no value is less.

    ``within``: flags of the compared values along the axis; absent: all.
    """
    difference = above(value, other)
    if within is not None:
        value, other = value.where(within, 0.0), other.where(within, 0.0)
        difference = difference.where(within, 1.0)
    never_below = plain(difference.min(axis, skipna=False) + word.band)
    return all_of(more(value.mean(axis), other.mean(axis), word), never_below)


def all_of(*conditions: Condition | xr.DataArray) -> Condition:
    """The condition that all conditions are met; a margin alone is a condition without a dead band.

    The answer is "no difference" if no condition is false, and one has no difference.
    """
    first, *others = (c if isinstance(c, Condition) else plain(c) for c in conditions)
    margin, unless = first.margin, _not_false(first)
    for other in others:
        margin = xr.apply_ufunc(np.minimum, margin, other.margin)
        unless = unless & _not_false(other)
    return Condition(margin, unless & ~(margin > 0.0))


def all_along(condition: Condition, dims: str | list[str]) -> Condition:
    """A condition that must be met everywhere along dimensions; NaN if any margin is NaN."""
    margin = condition.margin.min(dims, skipna=False)
    return Condition(margin, _not_false(condition).all(dims) & ~(margin > 0.0))


def _not_false(condition: Condition) -> xr.DataArray:
    return (condition.margin > 0.0) | condition.same
