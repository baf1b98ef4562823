"""Valid values of a netCDF variable by its attributes, and variables with quality flags."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr


def within_valid_range(data: xr.Dataset) -> xr.Dataset:
    """The variables, without values outside ``valid_min``, ``valid_max`` or ``valid_range``.

    References
    ----------
    CF-1.11, 2.5.1; NetCDF User Guide, Attribute Conventions: values outside are missing values. The range of
    a packed variable refers to its packed values, if it has their type.
    """
    return data.assign({name: _within(values) for name, values in data.data_vars.items()})


def _within(values: xr.DataArray) -> xr.DataArray:
    if values.dtype.kind not in "fiu":
        return values
    low, high = values.attrs.get("valid_range", (None, None))
    ends = values.attrs.get("valid_min", low), values.attrs.get("valid_max", high)
    packing = values.encoding
    scale, offset = packing.get("scale_factor", 1.0), packing.get("add_offset", 0.0)
    # half of the smallest difference between packed values, for rounding
    slack = 0.5 * abs(scale) if {"scale_factor", "add_offset"} & packing.keys() else 0.0
    valid = np.ones(values.shape, bool)
    least, most = (None if end is None else float(end) for end in ends)
    if slack and all(end is None or np.asarray(end).dtype.kind in "iu" for end in ends):
        least, most = (None if end is None else scale * end + offset for end in (least, most))
        least, most = (most, least) if scale < 0.0 else (least, most)
    if least is not None:
        valid &= ~(values.values < least - slack)
    if most is not None:
        valid &= ~(values.values > most + slack)
    return values.where(valid) if not valid.all() else values


def quality_flags(data: xr.Dataset) -> list[str]:
    """Names of variables that flag the quality of others."""
    return sorted(
        str(name)
        for name, values in data.variables.items()
        if str(values.attrs.get("standard_name", "")).endswith(("status_flag", "quality_flag"))
        or "flag_meanings" in values.attrs
    )
