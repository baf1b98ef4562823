"""Rerun a point of a dataset from the scene in the dataset, and compare."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.diff import relative_change
from riserstudy.dataset.extremes import OVER
from riserstudy.dataset.label import labelled, to_dataset
from riserstudy.dataset.place import own_values, place
from riserstudy.dataset.provenance import read_provenance, scene_file_of
from riserstudy.files.digests import engine_digest
from riserstudy.records.facts import point_columns
from riserstudy.records.warning import NOT_ESTIMATED
from riserstudy.study.collect import laid_on, statistics
from riserstudy.study.common_nodes import NODE_DIGITS
from riserstudy.study.limits import uses
from riserstudy.study.modes import modes_result, variables_of

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.dataset.result import Result
    from riserstudy.scene.load import SceneFile

#: variables that are not results of a completed run
NOT_COMPARED = ("point_key", "by_request", "failure")


@dataclass(frozen=True)
class Rerun:
    """A point that was rerun."""

    place: dict[str, Any]  # its values on the axes
    # digests of the engine that made the dataset, and of the present engine
    engines: tuple[str, str]
    # largest change of each variable, divided by its largest magnitude; infinite if only one has a value
    changes: dict[str, float]
    # the complete labelled run, as from ``simulate``, with variables that the dataset does not keep
    run: xr.Dataset


def rerun(dataset: xr.Dataset, at: dict[str, str]) -> Rerun:
    """Rerun one point of a simulated dataset, or the single run of a dataset without axes.

    ``at``: values by axis, as text; not required for axes with one value. Raises InputError when the dataset
    was not simulated, or has no such point. Raises SimulationError when the run cannot be completed.
    """
    import xarray as xr

    from riserstudy.model.absent_effects import absent
    from riserstudy.simulation.refine import run

    engine = read_provenance(dataset)["engine"]
    index = place(dataset, at)
    point = own_values(dataset.isel(index))
    estimated = bool(
        point.get("error_estimated", np.isfinite(point.get("error_displacement", 0.0)))
    ) or NOT_ESTIMATED in _kinds(point)
    file = scene_file_of(dataset, index)
    result = run(file.resolved(), estimated=estimated)
    limits = uses(file, result, dataset) if "limit" in point.dims else {}
    modes = _modes(file, point)
    whole = to_dataset(result, file, absent(set(result.facts["effects"])))
    whole.attrs["source"] = dataset.attrs.get("scene_file") or dataset.attrs.get("source", "")
    repeated = xr.Dataset(statistics([result], [str(name) for name in point.data_vars])).squeeze()
    result = _on_nodes_of(point, result)
    new = labelled(result).merge(repeated.reindex_like(point[[OVER]]) if OVER in point else {})
    columns = point_columns()
    left_out = {*NOT_COMPARED, *(c.name for c in columns if not c.about.repeats)}
    facts = {c.name: c.value(result.facts) for c in columns if c.name not in left_out}
    found = dict(new) | facts | limits | modes
    return Rerun(
        {axis: point[axis].item() for axis in index},
        (engine, engine_digest()),
        {
            str(name): _change(old.values, _like(old, found.get(str(name))))
            for name, old in point.data_vars.items()
            if name not in left_out and not str(name).startswith("assumed_")
        },
        whole,
    )


def _kinds(point: xr.Dataset) -> set[str]:
    """Kinds of the warnings of a point."""
    records = point["warning_records"].item() if "warning_records" in point else "[]"
    return {one["kind"] for one in json.loads(records)}


def _modes(file: SceneFile, point: xr.Dataset) -> dict[str, NDArray[Any]]:
    """Modes of a scene, in the same number as the point has, by their names in its dataset."""
    if "natural_period" not in point:
        return {}
    count = point.sizes["mode"]
    made = variables_of([modes_result(file, count).arrays], count)
    return {name: values[0] for name, values in made.items()}


def _on_nodes_of(point: xr.Dataset, result: Result) -> Result:
    """A run interpolated to the nodes of a dataset, which are ``s`` if it keeps histories only."""
    own, at = result.arrays, result.arrays.get("s", result.arrays["s_node"])
    everywhere = at.shape == own["s_node"].shape and np.array_equal(at, own["s_node"])
    name = "s_node" if "s_node" in point.dims else "s"
    if name not in point.dims or not (everywhere or name == "s_node"):
        return result
    nodes = point[name].values
    same = nodes.shape == own["s_node"].shape and np.allclose(
        nodes, own["s_node"], rtol=0.0, atol=10.0**-NODE_DIGITS
    )
    return result if same else laid_on(result, nodes)


def _like(old: xr.DataArray, new: xr.DataArray | Any) -> NDArray[Any]:
    """Values of a run in the form of its dataset.

    The dataset repeats static values at all times of other points, and has NaN where only others have values.
    """
    if new is None:
        return np.full_like(old, np.nan) if old.dtype.kind == "f" else np.asarray(np.nan)
    if {*getattr(new, "dims", old.dims)} < {*old.dims}:
        new = new.broadcast_like(old).transpose(*old.dims)
    return np.asarray(new)


def _change(old: Any, new: Any) -> float:
    """Largest difference of two arrays, divided by their largest magnitude."""
    if old.shape != new.shape:
        return float("inf")
    if old.dtype.kind not in "fiub":  # text is either equal or not
        return 0.0 if np.array_equal(old, new) else float("inf")
    return relative_change(old, new)
