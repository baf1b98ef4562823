"""A word of size that claims use, apart from what compares by it: a plan reads it without arrays."""

from __future__ import annotations

from typing import NamedTuple


class Word(NamedTuple):
    """A word with its bound, a difference over the larger of the two values that are compared.

    ``most``: whether the bound is an upper one. ``band``: below this difference there is none.
    """

    name: str
    bound: float
    most: bool
    band: float
