"""Limits over a grid: the utilisation of each limit at every point."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.limits import Checked, checked, labels
from riserstudy.dataset.variables import attributes
from riserstudy.errors import InputError
from riserstudy.records.facts import point_columns
from riserstudy.study.study import Study

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.dataset.result import Result
    from riserstudy.scene.load import SceneFile

#: variables over ``limit``: the field of a checked limit that they hold, and its type
OVER_LIMITS: dict[str, tuple[str, type]] = {
    "use_of_limit": ("utilisation", float),
    "demand_of_limit": ("demand", float),
    "verdict_of_limit": ("verdict", object),
}
#: variable with the allowables, which is present only if they differ between points
ALLOWABLE = "allowable_of_limit"
FIELDS = ("mode", "side", "output", "at", "allowable", "unit", "origin")


def limited(study: Study) -> bool:
    """Whether the points of a study have limits, from its scene or from an axis."""
    paths = (path for steps in study.axes.values() for _, sets in steps for path in sets)
    return "limits" in study.base.tree or any(path.startswith("limits") for path in paths)


def add_limits(dataset: xr.Dataset, study: Study, results: list[Result]) -> None:
    """Add utilisation, demand and verdict of each limit over the axes and ``limit``, if the study has limits.

    Points of one mesh and step have similar errors, of which only some are estimated. A point without an
    estimate therefore has the largest errors of the study, by quantity. For a part of a study, these are
    ``study.largest_errors``, of the whole study.
    Allowables that differ between points are a variable, and are not in the attribute. Raises InputError when
    points have different limits; only allowables may differ.
    """
    if not limited(study):
        return
    known = study.largest_errors
    errors = dict(known) if known is not None else largest_errors(results)
    rows = [
        _checked(file, result, errors)
        for file, result in zip(
            map(study.grid.file, (point.index for point in study.plan)), results, strict=True
        )
    ]
    names = labels(rows[0])
    if any(labels(row) != names for row in rows):
        allowed = "give limits on the same outputs and places, with the same modes, at all points"
        raise InputError(study.where, "limits", "the limits differ between points of the study", allowed)
    shape = (*(len(steps) for steps in study.axes.values()), len(names))
    dims = (*study.axes, "limit")
    for name, (of, kind) in OVER_LIMITS.items():
        values: NDArray[Any] = np.array([[getattr(one, of) for one in row] for row in rows], kind)
        dataset[name] = (dims, values.reshape(shape), attributes(name))
    dataset.coords["limit"] = ("limit", names, attributes("limit"))
    allowables = np.array([[one.allowable for one in row] for row in rows], float)
    same = (allowables == allowables[0]).all(axis=0)
    if not same.all():
        dataset[ALLOWABLE] = (dims, allowables.reshape(shape), attributes(ALLOWABLE))
    about = [{name: getattr(one, name) for name in FIELDS} for one in rows[0]]
    dataset.attrs["limits"] = json.dumps(
        [row if one else row | {"allowable": None} for row, one in zip(about, same, strict=True)]
    )


def uses(file: SceneFile, result: Result, dataset: xr.Dataset) -> dict[str, NDArray[Any]]:
    """Values of one run for each limit of its scene, (n,) each, by the variables of ``add_limits``.

    ``dataset``: dataset of its study, whose largest errors apply to a run without an estimate.
    """
    columns = {c.about.part: c.name for c in point_columns() if c.fact == "error_estimate" and c.about.part}
    known = {part: dataset[name].values for part, name in columns.items() if name in dataset}
    errors = {part: float(np.nanmax(of)) for part, of in known.items() if np.isfinite(of).any()}
    rows = _checked(file, result, errors)
    return {
        name: np.array([getattr(one, of) for one in rows], kind)
        for name, (of, kind) in (OVER_LIMITS | {ALLOWABLE: ("allowable", float)}).items()
    }


def largest_errors(results: list[Result]) -> dict[str, float]:
    """Largest estimated relative error among runs (1), by quantity; empty if none has an estimate."""
    estimates = [result.facts.get("error_estimate", {}) for result in results]
    return {
        name: max(of.get(name, 0.0) for of in estimates)
        for name in dict.fromkeys(n for of in estimates for n in of)
    }


def _checked(file: SceneFile, result: Result, errors: dict[str, float]) -> list[Checked]:
    """The limits of a run; without an estimate of its own, with these relative errors (1), by quantity."""
    facts: dict[str, Any] = {**result.facts}
    if not facts.get("error_estimate") and errors:
        facts["error_estimate"] = errors
    return checked(file, file.resolved(), facts)
