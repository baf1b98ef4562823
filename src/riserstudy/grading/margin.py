"""How far a claim is from where it would turn: a signed distance, positive where it is true.

A difference over the larger of the two that are compared, so that 0.5 is a factor of two whatever the unit,
and conditions of one claim can be set beside each other: the least of them is the claim's.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

Value = xr.DataArray | NDArray[np.float64] | float


def above(value: Value, bound: Value, over: Value | None = None) -> xr.DataArray:
    """By how much a value is above a bound.

    Parameters
    ----------
    value, bound : finite, infinite, or not a number.
    over : what the difference is a share of, where the bound is zero; absent: the larger of both by size.

    Returns
    -------
    Within -1 to 1 for values of one sign, 1 and -1 where one of them is infinite, 0 where both are alike;
    not a number where one of them is none.
    """
    one, other = xr.broadcast(xr.DataArray(value), xr.DataArray(bound))
    one, other = one.astype(float), other.astype(float)
    size = np.maximum(abs(one), abs(other)) if over is None else over
    difference = one - other
    finite = np.isfinite(one) & np.isfinite(other)
    share = (difference / size).where(difference != 0.0, difference)
    margin: xr.DataArray = share.where(finite, np.sign(difference))
    # two that never come are neither before the other: an answer, and not a missing one
    return margin.where(~(np.isinf(one) & (one == other)), 0.0)


def below(value: Value, bound: Value, over: Value | None = None) -> xr.DataArray:
    """By how much a value is below a bound; as ``above``."""
    return above(bound, value, over)


def rising(values: xr.DataArray, axis: str, sign: float = 1.0) -> xr.DataArray:
    """By how much values rise (sign 1) or fall (-1) at the least of the steps along an axis."""
    before, after = values.isel({axis: slice(None, -1)}), values.isel({axis: slice(1, None)})
    before = before.assign_coords({axis: after[axis]})
    step = above(after, before) if sign > 0 else above(before, after)
    return everywhere(step, axis)


def everywhere(margin: xr.DataArray, dims: str | list[str]) -> xr.DataArray:
    """The least along dimensions, where a claim must be true all along; not a number where any is none."""
    return margin.min(dims, skipna=False)


def least(*margins: xr.DataArray) -> xr.DataArray:
    """The least of several conditions that must all be true."""
    smallest, *others = margins
    for other in others:
        smallest = xr.apply_ufunc(np.minimum, smallest, other)
    return smallest
