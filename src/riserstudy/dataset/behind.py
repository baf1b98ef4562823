"""The scene behind a dataset, from what the dataset says of itself alone."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.scene.models import Scene
from riserstudy.scene.origin import Origin

if TYPE_CHECKING:
    import xarray as xr


def provenance(dataset: xr.Dataset) -> dict[str, Any]:
    """Scene, tables and engine behind a dataset of a study or of one run.

    Raises
    ------
    InputError
        When the dataset was not simulated.
    """
    said = dataset.attrs
    if "provenance" in said:
        return {"origins": {}, **json.loads(said["provenance"])}
    if "scene" not in said or "tables" not in said:
        found = "does not hold a scene and its tables"
        allowed = "allowed is a dataset that was simulated, by this version or a later one"
        raise InputError("dataset", "", found, allowed)
    parts = {name: json.loads(said[name]) for name in ("scene", "tables")}
    origins = json.loads(said.get("origins", "{}"))
    return parts | {"engine": said["engine"], "origins": origins}


@contextmanager
def file_behind(dataset: xr.Dataset, index: Mapping[str, int]) -> Iterator[SceneFile]:
    """The scene file of one point, with its tables, in a folder that is there as long as this lasts.

    Parameters
    ----------
    index : of the point on each axis; empty for a dataset without axes.

    Raises
    ------
    InputError
        When the dataset was not simulated.
    """
    record = provenance(dataset)
    sets: dict[str, Any] = {}
    for axis, k in index.items():
        sets |= json.loads(dataset[axis].attrs["sets"])[str(dataset[axis][k].item())]
    origins = {path: Origin(status, None) for path, status in record["origins"].items()}
    with tempfile.TemporaryDirectory() as folder:
        for name, text in record["tables"].items():
            table = Path(folder, name)
            table.parent.mkdir(parents=True, exist_ok=True)
            table.write_bytes(text.encode())
        source = str(Path(folder) / "scene.yaml")
        yield SceneFile(source, record["scene"], origins).with_values(sets, "axes")


def scene_behind(dataset: xr.Dataset, index: Mapping[str, int]) -> Scene:
    """The scene of one point, as ``file_behind`` has it."""
    with file_behind(dataset, index) as file:
        return file.scene()
