"""The scene behind a dataset, from what the dataset says of itself alone.

A dataset may come from anybody. What it holds is checked as a scene file is, its tables stay in memory, and
nothing that it names is read or written.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from riserstudy.errors import InputError
from riserstudy.inputs.plain_yaml import plain_fault
from riserstudy.scene.load import SceneFile
from riserstudy.scene.origin import Origin
from riserstudy.scene.resolve import Resolved

if TYPE_CHECKING:
    import xarray as xr


def provenance(dataset: xr.Dataset) -> dict[str, Any]:
    """Scene, tables and engine behind a dataset of a study or of one run.

    Returns
    -------
    dict
        ``scene`` is a plain tree, ``tables`` text by name, ``origins`` status by path, ``engine`` a digest.

    Raises
    ------
    InputError
        When the dataset was not simulated, or holds something else under these names.
    """
    attrs = dataset.attrs
    if "provenance" in attrs:
        record = {"origins": {}, "engine": "", **_mapping(dataset, "provenance")}
    elif "scene" in attrs and "tables" in attrs:
        names = [name for name in ("scene", "tables", "origins") if name in attrs]
        parts = {name: _mapping(dataset, name) for name in names}
        record = {"origins": {}, "engine": attrs.get("engine", ""), **parts}
    else:
        record = {}
    if "scene" not in record or "tables" not in record:
        found = "does not hold a scene and its tables"
        allowed = "allowed is a dataset that was simulated, by this version or a later one"
        raise InputError("dataset", "", found, allowed)
    for name in ("tables", "origins"):
        texts = record[name]
        if not isinstance(texts, dict) or not all(isinstance(t, str) for t in texts.values()):
            raise _damaged(dataset, name, "no text by name")
    if not isinstance(record["engine"], str):
        raise _damaged(dataset, "engine", "no text")
    if not isinstance(record["scene"], dict):
        raise _damaged(dataset, "scene", "no mapping")
    if fault := plain_fault(record["scene"]):
        raise InputError(_name(dataset), *fault)
    return record


def scene_file_of(dataset: xr.Dataset, index: Mapping[str, int]) -> SceneFile:
    """The scene file of one point, which holds its tables.

    Parameters
    ----------
    index : of the point on each axis; empty for a dataset without axes.

    Raises
    ------
    InputError
        When the dataset was not simulated, or holds no scene of the point.
    """
    record = provenance(dataset)
    sets: dict[str, Any] = {}
    for axis, k in index.items():
        of_axis, value = _mapping(dataset[axis], "sets"), str(dataset[axis][k].item())
        if not isinstance(of_axis.get(value), dict):
            raise _damaged(dataset[axis], "sets", f"nothing for {axis} = {value}")
        if fault := plain_fault(of_axis[value], f"{axis}.sets"):
            raise InputError(_name(dataset), *fault)
        sets |= of_axis[value]
    if "by_request" in dataset and dataset["by_request"].isel(index).item():
        request = _mapping(dataset, "request")
        if fault := plain_fault(request, "request"):
            raise InputError(_name(dataset), *fault)
        sets |= request
    origins = {path: Origin(status, None) for path, status in record["origins"].items()}
    source = _name(dataset)
    file = SceneFile(source, record["scene"], origins, held=record["tables"])
    return file.with_values(sets, f"{source}: axes")


def scene_of_point(dataset: xr.Dataset, index: Mapping[str, int]) -> Resolved:
    """The scene of one point, as ``scene_file_of`` has it."""
    return scene_file_of(dataset, index).resolved()


def _name(dataset: xr.Dataset | xr.DataArray) -> str:
    """How errors name a dataset: by its file, where it was read from one."""
    return str(dataset.encoding.get("source", "dataset"))


def _mapping(labelled: xr.Dataset | xr.DataArray, name: str) -> dict[str, Any]:
    """What an attribute holds as JSON."""
    try:
        value = json.loads(labelled.attrs[name])
    except (KeyError, TypeError, ValueError, RecursionError):
        raise _damaged(labelled, name, "no JSON") from None
    if not isinstance(value, dict):
        raise _damaged(labelled, name, "no mapping")
    return value


def _damaged(labelled: xr.Dataset | xr.DataArray, name: str, found: str) -> InputError:
    """What is said of a dataset that no simulation wrote like this."""
    allowed = "the file is damaged, or not of this program; run its scene again"
    return InputError(_name(labelled), name, found, allowed)
