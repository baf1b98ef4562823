"""Limits over a grid: what every point uses of each."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np

from riserstudy.dataset.limits import checked, label
from riserstudy.dataset.variables import attributes
from riserstudy.errors import InputError
from riserstudy.study.study import Study

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.dataset.result import Result

TOLD = ("mode", "side", "output", "at", "allowable", "unit", "origin")


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
        checked(file, file.scene(), result.facts.get("extremes", []))
        for file, result in zip(map(study.grid.file, _places(study)), results, strict=True)
    ]
    labels = [label(one) for one in rows[0]]
    if any([label(one) for one in row] != labels for row in rows):
        allowed = "allowed are the same outputs, places and modes at all points"
        raise InputError(study.where, "limits", "not those of all points", allowed)
    shape = (*(len(steps) for steps in study.axes.values()), len(labels))
    dims = (*study.axes, "limit")

    def add(name: str, values: list[list[float | None]] | list[list[str]], kind: type) -> None:
        dataset[name] = (dims, np.array(values, kind).reshape(shape), attributes(name))

    add("use_of_limit", [[one.utilisation for one in row] for row in rows], float)
    add("demand_of_limit", [[one.demand for one in row] for row in rows], float)
    add("verdict_of_limit", [[one.verdict for one in row] for row in rows], object)
    dataset.coords["limit"] = ("limit", labels, attributes("limit"))
    dataset.attrs["limits"] = json.dumps(
        [{name: getattr(one, name) for name in TOLD} for one in rows[0]]
    )


def _places(study: Study) -> list[tuple[int, ...]]:
    return [point.index for point in study.plan]
