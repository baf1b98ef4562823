"""Comparisons in the words of a claim: one bound a word, and a difference below which there is none.

A claim of a change is true from the bound of
its word on, "no difference" where the change is within the dead band, else false.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from riserstudy.grading.margin import Value, above
from riserstudy.grading.word import Word


class Condition(NamedTuple):
    """A condition of a claim: its margin, above zero where it is met, and where nothing differs."""

    margin: xr.DataArray
    same: xr.DataArray


def more(value: Value, other: Value, word: Word) -> Condition:
    """A value exceeds another by as much as a word says."""
    difference = above(value, other)
    return Condition(difference - word.bound, abs(difference) < word.band)


def less(value: Value, other: Value, word: Word) -> Condition:
    """A value is below another by as much as a word says."""
    return more(other, value, word)


def alike(value: Value, other: Value, word: Word) -> Condition:
    """Two values differ by no more than a word says."""
    return plain(word.bound - abs(above(value, other)))


def plain(margin: xr.DataArray) -> Condition:
    """A condition that is met or not, as a bound in seconds is."""
    return Condition(margin, xr.zeros_like(margin, bool))


def growing(values: xr.DataArray, axis: str, word: Word, sign: float = 1.0) -> Condition:
    """Values grow (sign 1) or fall (-1) along an axis by as much as a word says, and never turn back.

    From the first to the last value; a step the other way counts where it is a difference at all.
    """
    first, last = (values.isel({axis: end}, drop=True) for end in (0, -1))
    before, after = values.isel({axis: slice(None, -1)}), values.isel({axis: slice(1, None)})
    before = before.assign_coords({axis: after[axis]})
    steps = above(after, before) if sign > 0 else above(before, after)
    whole = more(last, first, word) if sign > 0 else less(last, first, word)
    return all_of(whole, plain(steps.min(axis, skipna=False) + word.band))


def more_on_the_whole(
    value: xr.DataArray,
    other: xr.DataArray,
    word: Word,
    axis: str,
    within: xr.DataArray | None = None,
) -> Condition:
    """The mean along an axis exceeds another's by as much as a word says, and nowhere is it less.

    ``within``: where along the axis they are compared; absent: everywhere.
    """
    difference = above(value, other)
    if within is not None:
        value, other = value.where(within, 0.0), other.where(within, 0.0)
        difference = difference.where(within, 1.0)
    never_below = plain(difference.min(axis, skipna=False) + word.band)
    return all_of(more(value.mean(axis), other.mean(axis), word), never_below)


def all_of(*conditions: Condition | xr.DataArray) -> Condition:
    """All conditions at once; a margin alone is one without dead band.

    No difference where none is false, and one compares what does not differ.
    """
    first, *others = (c if isinstance(c, Condition) else plain(c) for c in conditions)
    margin, unless = first.margin, _not_false(first)
    for other in others:
        margin = xr.apply_ufunc(np.minimum, margin, other.margin)
        unless = unless & _not_false(other)
    return Condition(margin, unless & ~(margin > 0.0))


def all_along(condition: Condition, dims: str | list[str]) -> Condition:
    """A condition that must be met all along dimensions; not a number where any margin is none."""
    margin = condition.margin.min(dims, skipna=False)
    return Condition(margin, _not_false(condition).all(dims) & ~(margin > 0.0))


def _not_false(condition: Condition) -> xr.DataArray:
    return (condition.margin > 0.0) | condition.same
