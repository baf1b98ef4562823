"""Conversion of a run's arrays to a labelled dataset."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from riserstudy.dataset.limits import checked
from riserstudy.dataset.provenance import package_version, provenance_of_run
from riserstudy.dataset.variables import ENDINGS, attributes
from riserstudy.files.digests import engine_digest
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.dataset.result import Result

# prefixes of arrays that give values between nodes, and displacements
UNLABELLED = ("zero_", "mesh_")
S_DIGITS = 9  # decimals of arclengths (m), so that a node can be selected by its arclength


def to_dataset(result: Result, file: SceneFile, effects_off: dict[str, str]) -> xr.Dataset:
    """Label and describe the arrays of a run, and add absent effects with the reasons."""
    dataset = with_details(labelled(result), file)
    for label in dataset.variables:
        dataset[label].attrs = attributes(str(label))
    dataset.attrs = {
        "Conventions": "CF-1.11",
        "title": file.tree.get("title", ""),
        "source": file.source,
        "effects_off": json.dumps(effects_off),
        "history": history("simulated a scene"),
        **{key: _text(value) for key, value in result.facts.items()},
        "warnings": json.dumps(sentences(result.facts["warnings"])),
        "provenance": json.dumps(provenance_of_run(file)),
    }
    if "limits" in file.tree:
        rows = checked(file, file.resolved(), result.facts)
        dataset.attrs["limits"] = json.dumps([row._asdict() for row in rows])
    return dataset


def with_details(dataset: xr.Dataset, file: SceneFile) -> xr.Dataset:
    """The dataset with the names of its scene's fatigue details."""
    if "detail" not in dataset.dims:
        return dataset
    names = [str(detail["name"]) for detail in file.tree["fatigue"]["details"]]
    return dataset.assign_coords(detail=names)


def labelled(result: Result) -> xr.Dataset:
    """The arrays of a run with their dimensions, without attributes."""
    import xarray as xr

    arrays = result.arrays
    data = {label: (dims, arrays[name]) for label, (dims, name) in quantities(arrays).items()}
    return xr.Dataset(data, coordinates(arrays))


def coordinates(arrays: dict[str, Any]) -> dict[str, Any]:
    """Coordinates of a run; arclengths, which are sums of segments, are rounded, so 533 m is found."""
    coords: dict[str, Any] = {
        name: (name, arrays[name].round(S_DIGITS) if name != "time" else arrays[name])
        for name in ("time", "s", "s_node")
        if name in arrays
    }
    if (force := arrays.get("tensioner_force_static")) is not None:
        coords["cylinder"] = ("cylinder", list(range(len(force))))
    if (rate := arrays.get("damage_rate")) is not None:
        coords["wall_angle"] = ("wall_angle", np.arange(rate.shape[1]) * (360.0 / rate.shape[1]))
    if "time" not in arrays:
        coords["s"] = ("s", coords["s_node"][1])
    return coords


def quantities(arrays: dict[str, Any]) -> dict[str, tuple[tuple[str, ...], str]]:
    """Quantities of a run: dimensions, and name of the array; static arrays also have short names."""
    coords = coordinates(arrays)
    named = {
        name: (dimensions(name, values), name)
        for name, values in arrays.items()
        if name not in coords and name != "l0" and not name.startswith(UNLABELLED)
    }
    if "time" not in arrays:
        for name in [name for name in named if name.endswith("_static")]:
            dims = named[name][0]
            named[name.removesuffix("_static")] = (("s",) if "s_node" in dims else dims, name)
    return named


def dimensions(name: str, values: Any) -> tuple[str, ...]:
    """Dimensions of an array of a run, from its name and shape."""
    if name == "damage_rate":
        return ("detail", "wall_angle", "s_node")
    if name.startswith("tensioner_"):
        return ("time", "cylinder")[-values.ndim :]
    if name.endswith(tuple(ENDINGS)):
        return ("s_node",)[: values.ndim]
    return ("time", "s")[: values.ndim]


def history(done: str) -> str:
    """A line for the attribute ``history``, without a date, so that the same run gives the same file."""
    return f"riserstudy {package_version()}, engine {engine_digest()}: {done}"


def _text(value: Any) -> Any:
    return value if isinstance(value, int | float | str) else json.dumps(value)
