"""Where the values behind a dataset come from: those of its scene, and those that its axes set."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from riserstudy.scene.origin import unwrap
from riserstudy.scene.paths import within

if TYPE_CHECKING:
    import xarray as xr

#: of several origins of one path the first of these is told: what a verdict must not overlook
FIRST = ("calibrated", "assumed", "derived", "chosen")


def origins_of(dataset: xr.Dataset) -> dict[str, str]:
    """Origins of all values that any point of a dataset rests on, by path.

    Parameters
    ----------
    dataset : simulated, whose axes say what each of their values sets; or derived, which says it all itself.
    """
    origins: dict[str, str] = json.loads(dataset.attrs.get("origins", "{}"))
    if "parents" in dataset.attrs or "point_key" not in dataset:
        return origins
    of = {path: {status} for path, status in origins.items()}
    axes = dataset["point_key"].dims
    picked = [name for name in dataset.coords if name not in axes]  # one value of what was an axis
    for axis in (*axes, *picked):
        sets = json.loads(dataset[axis].attrs.get("sets", "{}"))
        values = [sets.get(str(value), {}) for value in np.ravel(dataset[axis].values).tolist()]
        of = {p: found for p, found in of.items() if not all(_cover(one, p) for one in values)}
        for path, status in _statuses(values):
            of.setdefault(path, set()).add(status)
    return _first(of)


def joined(origins: Iterable[Mapping[str, str]]) -> dict[str, str]:
    """Origins of several datasets as one; as ``origins_of`` tells one of several."""
    of: dict[str, set[str]] = {}
    for one in origins:
        for path, status in one.items():
            of.setdefault(path, set()).add(status)
    return _first(of)


def _first(of: Mapping[str, set[str]]) -> dict[str, str]:
    return {path: min(found, key=FIRST.index) for path, found in of.items()}


def _cover(sets: Mapping[str, Any], path: str) -> bool:
    """Whether a value of an axis takes the place of what stands at a path."""
    return any(within(path, own) for own in sets)


def _statuses(values: Iterable[Mapping[str, Any]]) -> Iterator[tuple[str, str]]:
    """What values of an axis say of themselves, by path."""
    for sets in values:
        for path, value in sets.items():
            for place, origin in unwrap(value, path)[1].items():
                yield place, origin.status
