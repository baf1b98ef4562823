"""Adds the attributes that CF requires of every variable, where a dataset lacks them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.dataset.variables import attributes, cf_unit

if TYPE_CHECKING:
    import xarray as xr


def complete(dataset: xr.Dataset) -> xr.Dataset:
    """The dataset with a long name for every variable, a unit for every number, and no fill value on axes.

    Existing attributes are kept, but units have one spelling. Numbers without a unit are counts, shares or
    flags, whose unit is 1.
    """
    dataset = dataset.copy()
    for label, variable in dataset.variables.items():
        attrs = dict(variable.attrs)
        known = attributes(str(label))
        numbers = variable.dtype.kind in "fiu"
        about = {"long_name": str(label).replace("_", " ")}
        if numbers and ("long_name" not in attrs or str(label).startswith("assumed_")):
            about["units"] = "1"
        about |= {name: known[name] for name in ("units", "long_name") if name in known}
        about |= attrs
        if numbers and "units" in about:
            about["units"] = cf_unit(about["units"])
        variable.attrs = about
        if label in dataset.coords and numbers:
            variable.encoding["_FillValue"] = None
    dataset.attrs.setdefault("Conventions", "CF-1.11")
    return dataset
