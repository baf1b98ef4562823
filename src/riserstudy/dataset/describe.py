"""Functions for derived datasets: their attributes, sampled inputs, and the scenes of points."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import xarray as xr

from riserstudy.dataset.provenance import scene_of_point
from riserstudy.dataset.title import titled
from riserstudy.dataset.variables import attributes
from riserstudy.scene.resolve import Resolved


def described(dataset: xr.Dataset, paper: str, title: str) -> xr.Dataset:
    """The dataset with CF attributes, without coordinates that are not dimensions."""
    for name in dataset.variables:
        kept = {k: v for k, v in dataset[name].attrs.items() if str(name).startswith("assumed_")}
        dataset[name].attrs = attributes(str(name)) | kept
    dataset.attrs = {"Conventions": "CF-1.11", "paper": paper, "title": titled(title, paper)}
    return dataset.drop_vars([n for n in dataset.coords if n not in dataset.dims])


def label_variables(dataset: xr.Dataset, about: Mapping[str, tuple[str, str]]) -> None:
    """Give variables their units and long names. ``about``: (units, long name) by variable."""
    for name, (unit, words) in about.items():
        dataset[name].attrs = {"units": unit, "long_name": words}


def sampled(source: xr.Dataset) -> dict[str, xr.DataArray]:
    """The inputs that each sample assumes."""
    return {str(n): v for n, v in source.data_vars.items() if str(n).startswith("assumed_")}


def scenes_of(dataset: xr.Dataset) -> Iterator[tuple[dict[str, Any], Resolved]]:
    """The position on the axes and the scene of every point of a simulated dataset."""
    axes = [str(dim) for dim in dataset["point_key"].dims]
    for place in np.ndindex(dataset["point_key"].shape):
        index = dict(zip(axes, place, strict=True))
        values = {axis: dataset[axis].values[k].item() for axis, k in index.items()}
        yield values, scene_of_point(dataset, index)
