"""Margin of a claim: signed distance from its change between true and false, positive where it is true.

It is the difference of two compared values divided by the larger one. In any unit, 0.5 is therefore a factor
of two, and margins of several conditions of a claim can be compared: the margin of the claim is the smallest
of them.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

Value = xr.DataArray | NDArray[np.float64] | float


def above(value: Value, bound: Value, over: Value | None = None) -> xr.DataArray:
    """Relative amount by which a value exceeds a bound.

    Parameters
    ----------
    value, bound : finite, infinite, or NaN.
    over : reference value of the difference, for a bound of zero; absent: the larger magnitude of both.

    Returns
    -------
    From -1 to 1 for values of the same sign, 1 or -1 if one of them is infinite, 0 if both are equal; NaN if
    one of them is NaN.
    """
    one, other = xr.broadcast(xr.DataArray(value), xr.DataArray(bound))
    one, other = one.astype(float), other.astype(float)
    size = np.maximum(abs(one), abs(other)) if over is None else over
    difference = one - other
    finite = np.isfinite(one) & np.isfinite(other)
    share = (difference / size).where(difference != 0.0, difference)
    margin: xr.DataArray = share.where(finite, np.sign(difference))
    # of two events that never occur, neither is before the other: this is an answer, not a missing value
    return margin.where(~(np.isinf(one) & (one == other)), 0.0)


def below(value: Value, bound: Value, over: Value | None = None) -> xr.DataArray:
    """Relative amount by which a value is below a bound; as ``above``."""
    return above(bound, value, over)


def rising(values: xr.DataArray, axis: str, sign: float = 1.0) -> xr.DataArray:
    """Smallest relative increase (sign 1) or decrease (-1) of values from step to step along an axis."""
    return everywhere(steps(values, axis, sign), axis)


def steps(values: xr.DataArray, axis: str, sign: float) -> xr.DataArray:
    """Relative increases (sign 1) or decreases (-1) of values from step to step along an axis."""
    before, after = values.isel({axis: slice(None, -1)}), values.isel({axis: slice(1, None)})
    before = before.assign_coords({axis: after[axis]})
    return above(after, before) if sign > 0 else above(before, after)


def everywhere(margin: xr.DataArray, dims: str | list[str]) -> xr.DataArray:
    """Smallest margin along dimensions, for a claim that must be true everywhere; NaN if any is NaN."""
    return margin.min(dims, skipna=False)


def least(*margins: xr.DataArray) -> xr.DataArray:
    """Smallest margin of several conditions that must all be true."""
    smallest, *others = margins
    for other in others:
        smallest = xr.apply_ufunc(np.minimum, smallest, other)
    return smallest
