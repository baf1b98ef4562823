"""Open the arrays of points that the database lists."""

from __future__ import annotations

import functools
import json
import math
from collections.abc import Hashable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from riserstudy.database.ask import DATABASE, ask, connect
from riserstudy.dataset.netcdf import refuse_damaged
from riserstudy.dataset.other_files import refuse_other_files
from riserstudy.dataset.unit_names import factor_between
from riserstudy.errors import InputError

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from riserstudy.dataset.result import Result
    from riserstudy.scene.load import SceneFile


def open_point(key: str, whole: bool = False) -> xr.Dataset:
    """Open the stored run of a point, as a dataset with the names and units of ``simulate``.

    The store contains only the variables that the studies of the point keep. The attribute ``left_out``
    lists the other variables, as JSON text.

    Parameters
    ----------
    key : str
        Key of the point; ``select key from points where ...`` finds it.
    whole : bool
        Return all variables. If the store does not contain them, the scene of the point is simulated again.

    Returns
    -------
    xarray.Dataset
        The run, as from :func:`simulate`.

    Raises
    ------
    InputError
        When the store does not contain the point, its stored file is damaged, or a table of the scene has
        changed since the point was simulated; with ``whole``, also when the engine has changed.
    """
    from riserstudy.dataset.label import to_dataset
    from riserstudy.model.absent_effects import absent
    from riserstudy.scene.load import SceneFile
    from riserstudy.scene.origin import Origin
    from riserstudy.scene.tables import names_of_tables
    from riserstudy.study import store

    held = store.all_of(key)
    if held is None:
        allowed = "use dataset_of for the outputs that the study keeps, or repeat the study"
        found = f"the cache does not contain the complete results of point {key!r}"
        raise InputError("cache", "", found, allowed)
    about, result = held
    left_out = about["left_out"]
    origins = {path: Origin(status, None) for path, status in about["origins"].items()}
    file = SceneFile(about["source"], about["scene"], origins)
    if whole and left_out:
        result, left_out = _anew(key, file, result), []
    elif [*names_of_tables(about["scene"])]:
        _refuse_other_tables(key, file, about["engine"])
    dataset = to_dataset(result, file, absent(set(result.facts["effects"])))
    provenance = json.loads(dataset.attrs["provenance"]) | {"engine": about["engine"]}
    del provenance["riserstudy"]  # the engine digest identifies the code that simulated the point
    dataset.attrs["provenance"] = json.dumps(provenance)
    dataset.attrs["left_out"] = json.dumps(left_out)
    return dataset


def _refuse_other_tables(key: str, file: SceneFile, engine: str) -> None:
    """Refuse a point whose tables have changed: the dataset would state tables that it was not run with.

    ``engine``: digest of the engine that simulated it.
    """
    from riserstudy.files.digests import engine_digest
    from riserstudy.study import store

    if store.key_of(file.resolved(), engine) != key:
        other = "" if engine == engine_digest() else ", or by another version of the engine"
        found = f"point {key!r} was simulated with other tables than the present tables of {file.source}"
        raise InputError("cache", "", f"{found}{other}", "restore the tables, or use dataset_of")


def _anew(key: str, file: SceneFile, stored: Result) -> Result:
    """Simulate the run of a stored point again."""
    from riserstudy.simulation.refine import run
    from riserstudy.study import store

    scene = file.resolved()
    if store.key_of(scene) != key:
        found = f"point {key!r} was simulated by another version of the engine, or with other tables"
        allowed = "use whole=False, or `riserstudy rerun` with the dataset of the study"
        raise InputError("cache", "", found, allowed)
    return run(scene, estimated="error_estimate" in stored.facts)


def dataset_of(points: Iterable[Any], database: str | Path = DATABASE) -> xr.Dataset:
    """Join the stored variables of selected points into one dataset, along the dimension ``point``.

    If the studies of the points have different nodes or times, the dataset contains the nodes and times of
    all these studies. Where a study has no value, the dataset contains NaN. Nothing is interpolated. A value
    of a static study, which has no times, is the same at all times. Values that studies have in different
    units, such as axes in kN and MN, are converted to the unit of the first.

    Parameters
    ----------
    points : iterable of int
        Numbers of points, as in ``query("select point from ...")["point"]``.
    database : str or Path
        File of the results database. The datasets are in the folder of this file.

    Returns
    -------
    xarray.Dataset
        The points in the order of ``points``, with the axes of their studies as coordinates.

    Raises
    ------
    InputError
        When a point does not exist, the dataset file that the database names is missing, or two studies have
        a value in units of different dimensions.
    """
    import xarray as xr

    wanted = [int(point) for point in points]
    places: dict[int, tuple[str, str, int]] = {}
    with connect(database) as db:
        statement = "select study, path, position from points join studies using (study) where point = ?"
        for point in wanted:
            for row in ask(db, statement, (point,)).rows:
                places[point] = row
    if not wanted or (missing := [point for point in wanted if point not in places]):
        missing_text = f"there is no point {missing[0]}" if wanted else "no point is given"
        raise InputError(database, "points", missing_text, "give numbers from the table `points`")
    parts: list[xr.Dataset] = []
    for study, path in dict.fromkeys((places[point][0], places[point][1]) for point in wanted):
        mine = [point for point in places if places[point][0] == study]
        part = _part(Path(database).parent / path, mine, [places[p][2] for p in mine], study)
        parts.append(_in_units_of(parts, part, study))
    if len(parts) == 1:
        return parts[0].sel(point=wanted)
    # an axis that is missing in some studies is a variable while the studies are joined
    coords = {str(name): of.dims for part in parts for name, of in part.coords.items()}
    axes = [n for n, dims in coords.items() if dims == ("point",) and n not in ("point", "study")]
    joined: xr.Dataset = xr.concat(
        [part.reset_coords([axis for axis in axes if axis in part.coords]) for part in _on_all_dims(parts)],
        "point",
        data_vars="all",
        join="outer",
        combine_attrs="drop_conflicts",
    )
    return joined.set_coords(axes).sel(point=wanted)


def _on_all_dims(parts: list[xr.Dataset]) -> list[xr.Dataset]:
    """Points of studies, each with the nodes, times and other places of all of them.

    A value of a study without a dimension is the same along it.
    """
    dims = dict.fromkeys(dim for part in parts for dim in part.indexes if dim != "point")
    have = {dim: [part for part in parts if dim in part.indexes] for dim in dims}
    union = {dim: _union([part.indexes[dim] for part in of]) for dim, of in have.items()}
    whole = {dim: (dim, union[dim], of[0][dim].attrs) for dim, of in have.items()}
    of_name: dict[Hashable, set[Hashable]] = {}
    for part in parts:
        for name, of in part.data_vars.items():
            of_name.setdefault(name, set()).update(dims.keys() & {*of.dims})
    made = []
    for part in parts:
        full = part
        for dim in dims:
            if dim in part.indexes:
                places = _numbered(union[dim]).get_indexer(_numbered(part.indexes[dim]))
                full = full.assign_coords({dim: places}).reindex({dim: range(len(union[dim]))})
        full = full.assign_coords(whole)
        for name, of in part.data_vars.items():
            lacks = {dim: full[dim] for dim in dims if dim in of_name[name] - {*of.dims}}
            full[name] = full[name].expand_dims(lacks, [*range(1, 1 + len(lacks))])
        made.append(full)
    return made


def _union(indexes: list[pd.Index]) -> pd.Index:
    """Places of all studies; a place that a study has twice, such as the node of two sections, twice."""
    if all(index.equals(indexes[0]) for index in indexes):
        return indexes[0]
    return functools.reduce(lambda one, other: one.union(other), indexes)


def _numbered(index: pd.Index) -> pd.MultiIndex:
    """Places with a number, which differs where they are equal."""
    import pandas as pd

    return pd.MultiIndex.from_arrays([index, pd.Series(index).groupby(index).cumcount()])


def _in_units_of(others: list[xr.Dataset], part: xr.Dataset, study: str) -> xr.Dataset:
    """Points of a study, with the units of the studies before it."""
    for name in map(str, part.variables):
        before = next((other[name] for other in others if name in other.variables), part[name])
        units = [str(values.attrs.get("units", "")) for values in (part[name], before)]
        if units[0] == units[1] or {part[name].dtype.kind, before.dtype.kind} - {*"fiu"}:
            continue
        ratio = factor_between(units[0], units[1])
        if math.isnan(ratio):
            found = f"the unit is {units[0]!r}, but {units[1]!r} in another study"
            raise InputError(study, name, found, "select points of one of these studies")
        part[name] = (part[name].dims, ratio * part[name].values, before.attrs)
    return part


def _part(path: Path, points: list[int], positions: list[int], study: str) -> xr.Dataset:
    """Return some points of one dataset."""
    import numpy as np
    import xarray as xr

    if not path.is_file():
        raise InputError(path, "", "the dataset does not exist", "repeat the study, which writes it")
    refuse_damaged(path)
    refuse_other_files(path)
    with xr.open_dataset(path, engine="netcdf4") as dataset:
        axes = dataset["point_key"].dims
        if not axes:
            dataset = dataset.expand_dims("point")
            part = dataset.isel(point=[0] * len(points)).load()
        else:
            places = np.unravel_index(positions, [dataset.sizes[axis] for axis in axes])
            at = {axis: xr.DataArray(k, dims="point") for axis, k in zip(axes, places, strict=True)}
            part = dataset.isel(at).load()
    number = {"units": "1", "long_name": "number of the point in the results database"}
    name = {"long_name": "study of the point"}
    return part.assign_coords(point=("point", points, number), study=("point", [study] * len(points), name))
