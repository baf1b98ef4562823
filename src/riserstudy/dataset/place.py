"""Selection of one point of a dataset with axes, from text that a user types."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from riserstudy.dataset.extremes import OF_A_RUN
from riserstudy.errors import InputError, SimulationError

if TYPE_CHECKING:
    import xarray as xr


def place(dataset: xr.Dataset, at: dict[str, str]) -> dict[str, int]:
    """Index of a point on each axis; none for a dataset without axes.

    ``at``: values by axis, as text; not required for axes with one value. Raises InputError when the dataset
    has no such axis or value, or an axis has no value in ``at``.
    """
    axes = [str(axis) for axis in dataset["point_key"].dims] if "point_key" in dataset else []
    if unknown := [axis for axis in at if axis not in axes]:
        allowed = f"use one of {', '.join(axes)}" if axes else "omit --at, since the dataset has no axes"
        raise InputError("--at", unknown[0], "the dataset has no axis of this name", allowed)
    index = {}
    for axis in axes:
        values = dataset[axis].values.tolist()
        if axis not in at and len(values) > 1:
            allowed = f"add --at {axis}=VALUE with one of {', '.join(map(str, values))}"
            raise InputError("--at", axis, "a value of this axis is missing", allowed)
        index[axis] = value_of(dataset, axis, at.get(axis, str(values[0])))
    return index


def own_values(run: xr.Dataset) -> xr.Dataset:
    """One point of a study, or points along an axis, without coordinates that only other points have.

    Longer runs have later times, longer risers have more nodes, and fatigue may be computed at more angles.
    The values of this point there are NaN. A static point has one constant value at all times of the others.
    """
    if "point_key" not in run:
        return run
    if "time" in run.dims and "step" in run and run["step"].isnull().all():
        run = run.isel(time=0, drop=True)
    for dim in (dim for dim in OF_A_RUN if dim in run.dims):
        has = [
            values.notnull().any([d for d in values.dims if d != dim]).values
            for values in run.data_vars.values()
            if dim in values.dims and values.dtype.kind == "f"
        ]
        if has and (there := np.any(has, axis=0)).any():
            run = run.isel({dim: there})
    return run


def complete(run: xr.Dataset) -> xr.Dataset:
    """One point of a dataset, or points along an axis, with the variables that these points have.

    Raises SimulationError when one of them failed, and has no results.
    """
    reasons = run["failure"].values.reshape(-1).tolist() if "failure" in run else []
    if failed := [reason for reason in reasons if reason]:
        which = "this point has" if len(reasons) == 1 else f"{len(failed)} of {len(reasons)} points have"
        raise SimulationError(f"{which} no results: {failed[0]}")
    run = own_values(run)
    within = [name for name, values in run.data_vars.items() if {*OF_A_RUN} & {*values.dims}]
    absent = [name for name in within if "point_key" in run and run[name].isnull().all()]
    return run.drop_vars(absent)  # such as y of a run in a plane


def value_of(dataset: xr.Dataset, axis: str, wanted: str) -> int:
    """Index of the value of an axis that a text names. Raises InputError when the axis has no such value."""
    values = dataset[axis].values.tolist()
    matching = [k for k, value in enumerate(values) if _is(value, wanted)]
    if not matching:
        found = f"the axis has no value {wanted}"
        raise InputError("--at", axis, found, f"use one of {', '.join(map(str, values))}")
    return matching[0]


def _is(value: Any, text: str) -> bool:
    """Whether a text names a value of an axis."""
    if isinstance(value, str):
        return value == text
    try:
        return bool(value == float(text))
    except ValueError:
        return False
