"""Limits over a grid: what every point uses of each."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.limits import checked, label
from riserstudy.dataset.variables import attributes
from riserstudy.errors import InputError
from riserstudy.study.study import Study

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.dataset.result import Result
    from riserstudy.scene.load import SceneFile

#: variables over ``limit``: what of a checked limit they hold, and as what
OVER_LIMITS: dict[str, tuple[str, type]] = {
    "use_of_limit": ("utilisation", float),
    "demand_of_limit": ("demand", float),
    "verdict_of_limit": ("verdict", object),
}
FIELDS = ("mode", "side", "output", "at", "allowable", "unit", "origin")


def add_limits(dataset: xr.Dataset, study: Study, results: list[Result]) -> None:
    """Add use, demand and verdict of each limit over the axes and ``limit``, where the study has limits.

    Raises
    ------
    InputError
        When points differ in what they limit; allowables may differ.
    """
    if "limits" not in study.base.tree:
        return
    rows = [
        checked(file, file.resolved(), result.facts)
        for file, result in zip(
            map(study.grid.file, (point.index for point in study.plan)), results, strict=True
        )
    ]
    labels = [label(one) for one in rows[0]]
    if any([label(one) for one in row] != labels for row in rows):
        allowed = "allowed are the same outputs, places and modes at all points"
        raise InputError(study.where, "limits", "differ between points", allowed)
    shape = (*(len(steps) for steps in study.axes.values()), len(labels))
    dims = (*study.axes, "limit")

    for name, (of, kind) in OVER_LIMITS.items():
        values: NDArray[Any] = np.array([[getattr(one, of) for one in row] for row in rows], kind)
        dataset[name] = (dims, values.reshape(shape), attributes(name))
    dataset.coords["limit"] = ("limit", labels, attributes("limit"))
    dataset.attrs["limits"] = json.dumps(
        [{name: getattr(one, name) for name in FIELDS} for one in rows[0]]
    )


def uses(file: SceneFile, result: Result) -> dict[str, NDArray[Any]]:
    """What one run uses of each limit of its scene, by the name that ``add_limits`` gives it; (n,) each."""
    rows = checked(file, file.resolved(), result.facts)
    return {
        name: np.array([getattr(one, of) for one in rows], kind)
        for name, (of, kind) in OVER_LIMITS.items()
    }
