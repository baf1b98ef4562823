"""Adds the attributes that CF requires of every variable, where a dataset lacks them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from riserstudy.dataset.variables import attributes, cf_unit

if TYPE_CHECKING:
    import xarray as xr

NAMING = ("units", "long_name")  # attributes that together tell what a variable is


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


def without_inherited(dataset: xr.Dataset, sources: Iterable[xr.Dataset]) -> xr.Dataset:
    """The dataset without attributes that its named variables only inherited from a source.

    xarray gives a result the attributes of its operands: the ratio of two tensions would be a tension in N. A
    variable whose name has other attributes in `riserstudy.dataset.variables` loses those of a source's
    variable; `complete` then writes its own.
    """
    inherited = [
        (str(name), dict(values.attrs))
        for source in sources
        for name, values in source.variables.items()
        if all(key in values.attrs for key in NAMING)
    ]
    dataset = dataset.copy()
    for label, values in dataset.data_vars.items():
        known, found = attributes(str(label)), [values.attrs.get(key) for key in NAMING]
        for name, attrs in inherited:
            if name != label and known and found == [attrs[key] for key in NAMING]:
                own = {key: value for key, value in values.attrs.items() if attrs.get(key) != value}
                values.attrs = own
                break
    return dataset
