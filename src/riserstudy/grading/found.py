"""Results of checks, and their validity."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from riserstudy.errors import InputError
from riserstudy.grading.yardstick import Condition, plain

TRUE, NO_DIFFERENCE, FALSE = 1.0, 0.0, -1.0


class Found(NamedTuple):
    """The result of a check: a quantity, and for a claim whether it is true; over the same cells.

    ``given``: whether the premise of the claim is met, over samples; other samples are not judged. Absent:
    all are judged. ``margin``: distance of the claim from its change between true and false, see
    `riserstudy.grading.margin`. ``same``: whether it is not true because the compared values do not differ.
    Absent: nowhere.
    """

    value: xr.DataArray
    true: xr.DataArray | None = None
    given: xr.DataArray | None = None
    margin: xr.DataArray | None = None
    same: xr.DataArray | None = None

    def at(self, cell: Mapping[str, Any]) -> Found:
        """The result in one cell."""

        def of(part: xr.DataArray | None) -> Any:
            return None if part is None else part.sel({dim: v for dim, v in cell.items() if dim in part.dims})

        return Found(*map(of, self))

    def granted(self) -> Found:
        """The result in the samples that may be judged."""
        if self.given is None or "sample" not in self.given.dims:
            return self
        return self.at({"sample": self.given["sample"][self.given.values]})


def judged(
    value: xr.DataArray, judged_by: xr.DataArray | Condition, given: xr.DataArray | None = None
) -> Found:
    """The result of a claim that is true where its condition is met; a margin of NaN gives no answer.

    ``given``: as in `Found`; without the dimension ``sample``, it is that of all samples. Raises TypeError
    when it has another dimension.
    """
    if given is not None and set(given.dims) - {"sample"}:
        raise TypeError(f"a premise is over samples, not over {', '.join(map(str, given.dims))}")
    if given is not None and not given.dims and "sample" in value.dims:
        given = given.expand_dims(sample=value["sample"])
    condition = judged_by if isinstance(judged_by, Condition) else plain(judged_by)
    return Found(value, condition.margin > 0.0, given, *condition)


def answers(found: Found) -> xr.DataArray:
    """Answers to a claim, over the cells of its truth.

    Raises TypeError when the check does not judge a claim.

    Returns
    -------
    1 where it is true, 0 where the compared values do not differ, -1 where it is false; NaN where value or
    margin are NaN, since a missing value does not mean "false".
    """
    if found.true is None:
        raise TypeError("a check that judges no claim has no answers")
    known = found.value.notnull()
    known = known.all([dim for dim in known.dims if dim not in found.true.dims])
    if found.margin is not None:
        known = known & np.isfinite(found.margin)
    answer: xr.DataArray = xr.where(found.true, TRUE, FALSE)
    if found.same is not None:
        answer = answer.where(found.true | ~found.same, NO_DIFFERENCE)
    return answer.where(known).transpose(*found.true.dims)


def consistent(found: Found, paper: str, check: str) -> Found:
    """Check the consistency of a result, and return it.

    Raises InputError when the result is true with a negative margin, or false with a positive margin.
    """
    if found.true is None or found.margin is None:
        return found
    margin = found.margin
    against = (found.true & (margin < 0.0)) | (~found.true & (margin > 0.0))
    if bool(against.any()):
        worst = float(abs(margin.where(against)).max())
        answer = "true" if bool((found.true & (margin < 0.0)).any()) else "false"
        found_text = f"the check is {answer} where its margin is {-worst if answer == 'true' else worst:.3g}"
        allowed = "return `judged(value, margin)`, which is true where the margin is above zero"
        raise InputError(f"chapters/{paper}/claims.py", check, found_text, allowed)
    return found


def at_cell(found: Found, cell: Mapping[str, Any], where: str, field: str) -> Found:
    """One cell of a result.

    Raises InputError when it has no such axis, or the axis does not have the value.
    """
    for axis, value in cell.items():
        there = found.value if axis in found.value.dims else found.true
        if there is None or axis not in there.dims:
            axes = ", ".join(map(str, (found.value if there is None else there).dims))
            allowed = f"use one of {axes}" if axes else "remove it, since the result has no axes"
            found_text = "the result of the check has no axis of this name"
            raise InputError(where, f"{field}.{axis}", found_text, allowed)
        values = there[axis].values.tolist()
        if value not in values:
            allowed = "use one of " + ", ".join(map(str, values))
            raise InputError(where, f"{field}.{axis}", f"{value!r} is not a value of this axis", allowed)
    return found.at(cell)
