"""Values that are the same but for how they were written: 6 s and 0.1 min differ by rounding."""

from __future__ import annotations

import math
from collections.abc import Iterable

ROUNDING = 1e-9  # relative: of conversions between units, and far below what anybody tells apart


def alike(values: Iterable[float | None]) -> bool:
    """Whether all of some values (of one SI unit, or 1) are the same; None is like nothing but itself."""
    every = list(values)
    numbers = [value for value in every if value is not None]
    if not numbers:
        return True
    return len(numbers) == len(every) and math.isclose(max(numbers), min(numbers), rel_tol=ROUNDING)
