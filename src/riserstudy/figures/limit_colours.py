"""Colours of limits: a limit has one colour in all figures of a dataset."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from riserstudy.figures.style import COLOURS, MANY_COLOURS, shades


def colours_of(limits: Iterable[str]) -> dict[str, str]:
    """Colour of each limit of a dataset, by its place, which does not depend on what a figure shows.

    ``limits``: names of all limits of the dataset, in its order.
    """
    names = [str(name) for name in limits]
    return dict(zip(names, _palette(len(names)), strict=True))


def _palette(count: int) -> Sequence[str]:
    """Distinct colours, the basic ones first."""
    if count <= len(MANY_COLOURS):
        return MANY_COLOURS[:count]
    *hues, black = COLOURS
    each = math.ceil((count - 1) / len(hues))
    return [black, *(shades(hue, each)[k] for k in range(each) for hue in hues)][:count]
