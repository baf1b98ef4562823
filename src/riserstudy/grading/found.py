"""What checks find, and what of it may be believed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from riserstudy.errors import InputError


class Found(NamedTuple):
    """What a check finds: a quantity, and for a claim whether it is true; over the same cells.

    ``given``: where what the claim takes for granted is so, over samples; others are not judged. Absent: all.
    ``margin``: how far the claim is from where it would turn, as `riserstudy.grading.margin` has it.
    """

    value: xr.DataArray
    true: xr.DataArray | None = None
    given: xr.DataArray | None = None
    margin: xr.DataArray | None = None

    def at(self, cell: Mapping[str, Any]) -> Found:
        """One cell of it."""

        def of(part: xr.DataArray | None) -> Any:
            return (
                None
                if part is None
                else part.sel({dim: v for dim, v in cell.items() if dim in part.dims})
            )

        return Found(*map(of, self))

    def granted(self) -> Found:
        """The samples that may be judged."""
        if self.given is None or "sample" not in self.given.dims:
            return self
        return self.at({"sample": self.given["sample"][self.given.values]})


def judged(value: xr.DataArray, margin: xr.DataArray, given: xr.DataArray | None = None) -> Found:
    """A claim that is true where its margin is above zero."""
    return Found(value, margin > 0.0, given, margin)


def sound(found: Found, paper: str, check: str) -> Found:
    """What a check found, true nowhere without a number or a margin that is one.

    Raises
    ------
    InputError
        When the check says true where its margin is negative, or false where it is positive.
    """
    if found.true is None:
        return found
    margin = found.margin
    if margin is not None:
        against = (found.true & (margin < 0.0)) | (~found.true & (margin > 0.0))
        if bool(against.any()):
            worst = float(abs(margin.where(against)).max())
            said = "true" if bool((found.true & (margin < 0.0)).any()) else "false"
            found_text = (
                f"says {said} where its margin is {-worst if said == 'true' else worst:.3g}"
            )
            allowed = "return `judged(value, margin)`, which is true where the margin is above zero"
            raise InputError(f"chapters/{paper}/claims.py", check, found_text, allowed)
    numbers = found.value.notnull()
    numbers = numbers.all([dim for dim in numbers.dims if dim not in found.true.dims])
    if margin is not None:
        numbers = numbers & np.isfinite(margin)
        margin = margin.where(numbers)
    true = (found.true & numbers).transpose(*found.true.dims)
    return found._replace(true=true, margin=margin)


def at_cell(found: Found, cell: Mapping[str, Any], where: str, field: str) -> Found:
    """One cell of what a check found.

    Raises
    ------
    InputError
        When it has no such axis, or not that value on it.
    """
    for axis, value in cell.items():
        there = found.value if axis in found.value.dims else found.true
        if there is None or axis not in there.dims:
            axes = ", ".join(map(str, (found.value if there is None else there).dims))
            allowed = (
                f"allowed are {axes}" if axes else "leave it out: what the check finds has none"
            )
            raise InputError(where, f"{field}.{axis}", "no axis of what the check finds", allowed)
        values = there[axis].values.tolist()
        if value not in values:
            allowed = "allowed are " + ", ".join(map(str, values))
            raise InputError(where, f"{field}.{axis}", f"{value!r} is not on that axis", allowed)
    return found.at(cell)
