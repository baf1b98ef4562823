"""One point of a dataset that has axes, by what a user types of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from riserstudy.errors import InputError, SimulationError

if TYPE_CHECKING:
    import xarray as xr


def place(dataset: xr.Dataset, at: dict[str, str]) -> dict[str, int]:
    """Index of a point on each axis; none for a dataset without axes.

    Parameters
    ----------
    at : value by axis, as text; axes of one value need none.

    Raises
    ------
    InputError
        When the dataset has no such axis or value, or an axis is left open.
    """
    axes = [str(axis) for axis in dataset["point_key"].dims] if "point_key" in dataset else []
    if unknown := [axis for axis in at if axis not in axes]:
        allowed = f"allowed are {', '.join(axes)}" if axes else "it has none"
        raise InputError("--at", unknown[0], "no axis of the dataset", allowed)
    index = {}
    for axis in axes:
        values = dataset[axis].values.tolist()
        if axis not in at and len(values) > 1:
            allowed = f"allowed are {', '.join(map(str, values))}"
            raise InputError("--at", axis, "not given", allowed)
        index[axis] = value_of(dataset, axis, at.get(axis, str(values[0])))
    return index


def complete(run: xr.Dataset) -> xr.Dataset:
    """One point of a dataset, or points along an axis, as they are.

    Raises
    ------
    SimulationError
        When one of them failed, so that it has no results.
    """
    if "failure" not in run:
        return run
    reasons = run["failure"].values.reshape(-1).tolist()
    if failed := [reason for reason in reasons if reason]:
        which = (
            "this point has"
            if len(reasons) == 1
            else f"{len(failed)} of {len(reasons)} points have"
        )
        raise SimulationError(f"{which} no results: {failed[0]}")
    return run


def value_of(dataset: xr.Dataset, axis: str, wanted: str) -> int:
    """Index of the value of an axis that a text names.

    Raises
    ------
    InputError
        When the axis has no such value.
    """
    values = dataset[axis].values.tolist()
    matching = [k for k, value in enumerate(values) if _is(value, wanted)]
    if not matching:
        raise InputError("--at", axis, wanted, f"allowed are {', '.join(map(str, values))}")
    return matching[0]


def _is(value: Any, text: str) -> bool:
    """Whether a text names a value of an axis."""
    if isinstance(value, str):
        return value == text
    try:
        return bool(value == float(text))
    except ValueError:
        return False
