"""The simulated studies that a dataset is derived from, with their axes, which identify points of a cell."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray as xr

Axes = dict[str, list[Any]]  # values by axis


def parent(source: xr.Dataset) -> dict[str, Any]:
    """The record of a source in a derived dataset: tier, engine, digest, and its axes or its sources.

    The digest covers scene, axes and points.
    """
    about = {name: source.attrs[name] for name in ("tier", "engine", "digest") if name in source.attrs}
    if "parents" in source.attrs:
        return about | {"parents": json.loads(source.attrs["parents"])}
    return about | ({"axes": axes_of(source)} if "point_key" in source else {})


def axes_of(dataset: xr.Dataset) -> Axes:
    """Axes of a simulated dataset, with their values."""
    return {str(axis): dataset[axis].values.tolist() for axis in dataset["point_key"].dims}


def supporting_studies(name: str, dataset: xr.Dataset) -> dict[str, Axes]:
    """Axes of the simulated studies that a dataset is derived from, or of itself if it is simulated; by name.

    ``name``: name of the dataset.
    """
    return _studies(name, parent(dataset))


def _studies(name: str, about: dict[str, Any]) -> dict[str, Axes]:
    found: dict[str, Axes] = {name: about["axes"]} if "axes" in about else {}
    for source, of in about.get("parents", {}).items():
        found |= _studies(source, of)
    return found
