"""Origins of a dataset's inputs: the values of its scene, and the values that its axes set."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from riserstudy.scene.origin import unwrap
from riserstudy.scene.paths import within_any

if TYPE_CHECKING:
    import xarray as xr

#: if a path has several origins, the first of these is reported, since a verdict must not overlook it
FIRST = ("calibrated", "assumed", "derived", "chosen")


def origins_of(dataset: xr.Dataset) -> dict[str, str]:
    """Origins of all values that any point of a dataset depends on, by path.

    ``dataset``: a simulated dataset, whose axes list the values that they set; or a derived dataset, whose
    attributes contain all origins.
    """
    origins: dict[str, str] = json.loads(dataset.attrs.get("origins", "{}"))
    if "parents" in dataset.attrs or "point_key" not in dataset:
        return origins
    of = {path: {status} for path, status in origins.items()}
    axes = dataset["point_key"].dims
    # a selected value of a former axis
    picked = [name for name in dataset.coords if name not in axes]
    for axis in (*axes, *picked):
        sets = json.loads(dataset[axis].attrs.get("sets", "{}"))
        values = [sets.get(str(value), {}) for value in np.ravel(dataset[axis].values).tolist()]
        of = {p: found for p, found in of.items() if not all(within_any(p, one) for one in values)}
        for path, status in _statuses(values):
            of.setdefault(path, set()).add(status)
    return _first(of)


def joined(origins: Iterable[Mapping[str, str]]) -> dict[str, str]:
    """Joint origins of several datasets; of several origins, one is selected as in ``origins_of``."""
    of: dict[str, set[str]] = {}
    for one in origins:
        for path, status in one.items():
            of.setdefault(path, set()).add(status)
    return _first(of)


def _first(of: Mapping[str, set[str]]) -> dict[str, str]:
    return {path: min(found, key=FIRST.index) for path, found in of.items()}


def _statuses(values: Iterable[Mapping[str, Any]]) -> Iterator[tuple[str, str]]:
    """Origins that values of an axis state, by path."""
    for sets in values:
        for path, value in sets.items():
            for place, origin in unwrap(value, path)[1].items():
                yield place, origin.status
