"""Values that are equal except for the rounding of unit conversions, such as 6 s and 0.1 min."""

from __future__ import annotations

import math
from collections.abc import Iterable

ROUNDING = 1e-9  # relative: covers unit conversions, and is far below any difference that matters


def alike(values: Iterable[float | None]) -> bool:
    """Whether all values (in one SI unit, or 1) are equal; None equals only None."""
    every = list(values)
    numbers = [value for value in every if value is not None]
    if not numbers:
        return True
    return len(numbers) == len(every) and math.isclose(max(numbers), min(numbers), rel_tol=ROUNDING)
