"""The scene of a dataset: how runs and studies store it, and how it is read.

A dataset may come from any source. Its content is checked like a scene file, its tables stay in memory, and
no file that it names is read or written.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from riserstudy.errors import InputError
from riserstudy.files.digests import engine_digest
from riserstudy.inputs.plain_yaml import plain_fault
from riserstudy.scene.load import SceneFile
from riserstudy.scene.origin import Origin
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.tables import texts_of_tables

if TYPE_CHECKING:
    import xarray as xr


def provenance_of_run(file: SceneFile) -> dict[str, Any]:
    """Version, engine and scene of a result, with the origin of each value that has one."""
    return {
        "riserstudy": package_version(),
        "engine": engine_digest(),
        "scene": file.tree,
        "tables": texts_of_tables(file.tree, Path(file.source).parent, file.held),
        "origins": {path: o.status for path, o in file.origins.items()},
        "plain_values": "published" if file.tree.get("paper") else "given",
    }


@cache
def package_version() -> str:
    """Version of this package; cached, because the lookup takes a millisecond."""
    return version("riserstudy")


def provenance_of_study(study_file: SceneFile, tables: Mapping[str, str]) -> dict[str, str]:
    """The same for a study, as separate attributes, with the evidence of each origin."""
    origins = study_file.origins
    return {
        "engine": engine_digest(),
        "riserstudy": package_version(),
        "scene": json.dumps(study_file.tree),
        "scene_file": study_file.source,
        "tables": json.dumps(dict(tables)),
        "origins": json.dumps({path: origin.status for path, origin in origins.items()}),
        "evidence": json.dumps({path: origin.why for path, origin in origins.items()}),
    }


def read_provenance(dataset: xr.Dataset) -> dict[str, Any]:
    """Scene, tables and engine of a dataset, which is a study or one run.

    Raises InputError when the dataset was not simulated, or the content of these attributes is wrong.

    Returns
    -------
    dict
        ``scene`` is a plain tree, ``tables`` text by name, ``origins`` status by path, ``engine`` a digest.
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
        found = "contains no scene and tables from which a point could be repeated"
        allowed = "give a dataset of simulated runs, written by this version or a later one"
        raise InputError("dataset", "", found, allowed)
    for name in ("tables", "origins"):
        texts = record[name]
        if not isinstance(texts, dict) or not all(isinstance(t, str) for t in texts.values()):
            raise _damaged(dataset, name, "is not a list of texts with names")
    if not isinstance(record["engine"], str):
        raise _damaged(dataset, "engine", "is not text")
    if not isinstance(record["scene"], dict):
        raise _damaged(dataset, "scene", "is not a group of fields")
    if fault := plain_fault(record["scene"]):
        raise InputError(name_of(dataset), *fault)
    return record


def scene_file_of(dataset: xr.Dataset, index: Mapping[str, int]) -> SceneFile:
    """The scene file of one point, which holds its tables.

    ``index``: index of the point on each axis; empty for a dataset without axes. An axis of which one value
    is already selected, as by ``isel``, has this value. Raises InputError when the dataset was not simulated,
    or has no scene of the point.
    """
    record, source = read_provenance(dataset), name_of(dataset)
    origins = {path: Origin(status, None) for path, status in record["origins"].items()}
    file = SceneFile(source, record["scene"], origins, held=record["tables"])
    for axis, label in _labels(dataset, index).items():
        of_axis, value = _mapping(dataset[axis], "sets"), str(label.item())
        if not isinstance(of_axis.get(value), dict):
            raise _damaged(dataset[axis], "sets", f"has no entry for {axis} = {value}")
        if fault := plain_fault(of_axis[value], f"{axis}.sets"):
            raise InputError(name_of(dataset), *fault)
        file = file.with_values(of_axis[value], f"{source}: axes")
    if "by_request" in dataset and dataset["by_request"].isel(index).item():
        request = _mapping(dataset, "request")
        if fault := plain_fault(request, "request"):
            raise InputError(name_of(dataset), *fault)
        file = file.with_values(request, f"{source}: axes")
    return file


def _labels(dataset: xr.Dataset, index: Mapping[str, int]) -> dict[str, xr.DataArray]:
    """The value of a point on each axis, selected already or by its index, in the order of the axes.

    Later axes replace values of earlier ones. A selection keeps the order of the coordinates.
    """
    selected = {str(n): of for n, of in dataset.coords.items() if of.ndim == 0 and "sets" in of.attrs}
    every = selected | {axis: dataset[axis][k] for axis, k in index.items()}
    order = [name for name in map(str, dataset.coords) if name in every]
    return {name: every[name] for name in dict.fromkeys([*order, *every])}


def scene_of_point(dataset: xr.Dataset, index: Mapping[str, int]) -> Resolved:
    """The resolved scene of one point, from ``scene_file_of``."""
    return scene_file_of(dataset, index).resolved()


def first_scene(dataset: xr.Dataset) -> Resolved:
    """The scene of a run, or of the first point of a study."""
    index = {str(axis): 0 for axis in dataset["point_key"].dims} if "point_key" in dataset else {}
    return scene_of_point(dataset, index)


def name_of(dataset: xr.Dataset | xr.DataArray) -> str:
    """Name of a dataset in errors: its file, if it was read from one."""
    return str(dataset.encoding.get("source", "dataset"))


def _mapping(labelled: xr.Dataset | xr.DataArray, name: str) -> dict[str, Any]:
    """The mapping in an attribute with JSON text."""
    try:
        value = json.loads(labelled.attrs[name])
    except (KeyError, TypeError, ValueError, RecursionError):
        raise _damaged(labelled, name, "is not JSON") from None
    if not isinstance(value, dict):
        raise _damaged(labelled, name, "is not a group of fields")
    return value


def _damaged(labelled: xr.Dataset | xr.DataArray, name: str, found: str) -> InputError:
    """The error for a dataset that no simulation can have written."""
    allowed = "repeat the run of its scene, since the file is damaged or not written by riserstudy"
    return InputError(name_of(labelled), name, found, allowed)
