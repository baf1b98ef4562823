"""A word of size in claims, separate from the comparisons, so that a plan can read it without arrays."""

from __future__ import annotations

from typing import NamedTuple


class Word(NamedTuple):
    """A word with its bound, which is a difference divided by the larger of the two compared values.

    ``most``: whether the bound is an upper one. ``band``: relative difference below which values do not
    differ.
    """

    name: str
    bound: float
    most: bool
    band: float
