"""Join the points of a study into one dataset."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.chapter_variables import chapter_table
from riserstudy.dataset.extremes import OF_A_RUN, OVER, as_variables, of_runs
from riserstudy.dataset.label import UNLABELLED, coordinates, dimensions, history, quantities, with_details
from riserstudy.dataset.limits import FACTS
from riserstudy.dataset.provenance import provenance_of_study
from riserstudy.dataset.result import Result
from riserstudy.dataset.title import titled
from riserstudy.dataset.variables import attributes, cf_unit
from riserstudy.errors import SimulationError
from riserstudy.records.facts import point_columns
from riserstudy.records.warning import OF_ESTIMATE
from riserstudy.records.words import counted
from riserstudy.scene.paths import as_name
from riserstudy.simulation.curve import at_stations, between_nodes, curve_of
from riserstudy.simulation.until import LOWER_ANGLE, count_until
from riserstudy.study import store
from riserstudy.study.axes import Numbers, Samples
from riserstudy.study.common_nodes import NODE_DIGITS, common_nodes
from riserstudy.study.grid import Point
from riserstudy.study.limits import add_limits, largest_errors, limited
from riserstudy.study.modes import add_modes
from riserstudy.study.needed import with_envelopes
from riserstudy.study.simulate_points import Count, fill, has_error_estimate, lacks
from riserstudy.study.study import Study, set_by_all

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.records.facts import RunFacts


HISTORIES = frozenset(("x", "y", "z", "effective_tension", "bending_moment"))  # over s
# attempts to simulate a point: a parallel study may store the point without arrays that this study keeps
ATTEMPTS = 3
SMALL = 4096  # size in bytes up to which equal arrays of several points are stored once


def results_of(
    study: Study,
    processes: int,
    notify: Callable[[str], None],
    count: Count | None = None,
    points: list[Point] | None = None,
) -> tuple[list[Result], int]:
    """Results of points in order, and the number of points that had to be simulated.

    At the end, ``notify`` is called with a sentence about this number; ``count`` is called for each completed
    point. Absent points: all. Raises SimulationError when points cannot be completed.
    """
    kept: dict[str, Result] = {}
    shared: dict[Any, Any] = {}
    wanted = study.plan if points is None else points
    absent, made = _take(study, wanted, kept, shared), 0
    for attempt in range(ATTEMPTS if absent else 0):
        now = fill(study, absent, processes, count)
        made = now if attempt == 0 else made
        absent = _take(study, absent, kept, shared)
        if not absent:
            break
    simulated = f"{counted(made, 'point')} simulated, {len(wanted) - made} from the store"
    notify(f"{study.paper}/{study.name}: {simulated}")
    if absent:
        raise SimulationError(
            f"{study.where}: results were deleted from the cache during the run; repeat the run"
        )
    return [kept[point.key] for point in wanted], made


def _take(study: Study, points: list[Point], kept: dict[str, Result], shared: dict[Any, Any]) -> list[Point]:
    """Read the arrays that a study keeps from the store; returns the points that lack some of them.

    Equal values of many points are kept in memory once, by ``shared``. An error estimate that another study
    with the same point required is left out, because a dataset must not depend on other studies.
    """
    # a few of the many facts of a point; statistics of the lower joint's angle end at the last one
    needed = {
        *(column.fact for column in point_columns()),
        *(FACTS if limited(study) else ()),
        "lower_joint_until",
    }
    for point in points:
        stored = store.get(point.key, study.model.keep)
        if stored is not None and not lacks(study, point, stored):
            about = stored.facts if has_error_estimate(study, point) else _without_estimate(stored.facts)
            facts = {
                name: value if isinstance(value, float) else _once(shared, value)
                for name, value in about.items()
                if name in needed
            }
            arrays = {name: _once(shared, values) for name, values in stored.arrays.items()}
            kept[point.key] = Result(arrays, cast("RunFacts", facts))
    return [point for point in points if point.key not in kept]


def _without_estimate(facts: RunFacts) -> RunFacts:
    """Facts of a run with a prescribed mesh, without its error estimate and the warnings that follow from it.

    The facts of a run for which the engine chose the mesh are returned unchanged, because such a run always
    has an estimate.
    """
    if "error_estimate" not in facts or "refinements" in facts:
        return facts
    other = {name: value for name, value in facts.items() if name != "error_estimate"}
    other["warnings"] = [one for one in facts["warnings"] if one["kind"] not in OF_ESTIMATE]
    return cast("RunFacts", other)


def _once(shared: dict[Any, Any], value: Any) -> Any:
    """The first value that was equal to this value, for small values of kinds that are often equal."""
    if isinstance(value, np.ndarray):
        if value.nbytes > SMALL:
            return value
        key: Any = (value.dtype.str, value.shape, value.tobytes())
    elif isinstance(value, dict | list):
        key = json.dumps(value)
    else:
        return value
    return shared.setdefault(key, value)


def dataset_of(study: Study, results: list[Result]) -> xr.Dataset:
    """Dataset with the study's axes as dimensions, over the quantities of its runs.

    Histories are at the requested stations. Values at nodes of different meshes are interpolated to common
    nodes (`common_nodes`) by the shape functions of each mesh. A riser has no values above its top.
    Statistics of points are those of the runs before interpolation.
    """
    import xarray as xr

    keep = study.model.keep
    point_statistics = statistics(results, keep)
    places, runs = by_layout(_on_common_nodes(results), keep)
    flat = xr.concat(runs, "point", join="outer", combine_attrs="drop", coords="minimal", compat="override")
    order = np.argsort([k for of in places for k in of])
    # without variables, there is no dimension `point`
    flat = flat.isel(point=order, missing_dims="ignore")
    flat = with_details(flat.assign(point_statistics), study.base)
    columns = {
        column.name: ("point", [column.value(r.facts) for r in results])
        for column in point_columns()
        if not column.about.optional or any(column.is_in(r.facts) for r in results)
    }
    flat = flat.assign(columns | {"point_key": ("point", [p.key for p in study.plan])})
    dataset = xr.Dataset(coords={n: flat[n] for n in (*OF_A_RUN, OVER) if n in flat.variables})
    for coordinate in dataset.coords:
        dataset[coordinate].attrs = attributes(str(coordinate))
    add_on_axes(dataset, flat, "point", study)
    _add_sampled(dataset, study)
    dataset.attrs = _about(study, results)
    add_limits(dataset, study, results)
    add_modes(dataset, study)
    return dataset


def add_on_axes(dataset: xr.Dataset, flat: xr.Dataset, points: str, study: Study) -> None:
    """Add the axes of a study, and variables over its points (a dimension of ``flat``) over these axes."""
    shape = tuple(len(steps) for steps in study.axes.values())
    on_axes: dict[Any, Any] = {}
    for label, values in flat.data_vars.items():
        values = values.transpose(points, ...)
        cells = values.values.reshape(shape + values.shape[1:])
        on_axes[label] = ((*study.axes, *values.dims[1:]), cells, attributes(str(label)))
    dataset.update(on_axes)  # all at once: each update of a dataset copies it
    for axis, steps in study.axes.items():
        about = _named(axis, study.model.axes[axis], study.paper)
        about["sets"] = json.dumps({str(value): sets for value, sets in steps})
        dataset.coords[axis] = (axis, [value for value, _ in steps], about)


def _named(name: str, axis: Any, paper: str) -> dict[str, Any]:
    """Attributes of an axis, with the unit that the study gives.

    An axis of words, or of numbers in another dimension, does not take the attributes of a variable that has
    its name, unless the chapter of the study names it.
    """
    known, unit = attributes(name), axis.unit if isinstance(axis, Numbers) else None
    meant = name in chapter_table(paper) or isinstance(axis, Samples)
    meant |= unit is not None and (unit == "1") == (known.get("units", unit) == "1")
    about = {"long_name": name.replace("_", " ")} | (known if meant else {})
    return about | ({"units": cf_unit(unit)} if unit is not None else {})


def _layouts(results: list[Result]) -> list[list[int]]:
    """Groups of indices of runs that have the same arrays over the same nodes and times."""
    places: dict[Any, list[int]] = {}
    for k, result in enumerate(results):
        shapes = tuple((name, values.shape) for name, values in result.arrays.items())
        over = [v.tobytes() for n, v in result.arrays.items() if n in ("time", "s", "s_node")]
        places.setdefault((shapes, *over), []).append(k)
    return list(places.values())


def statistics(results: list[Result], keep: Collection[str] | None) -> dict[str, Any]:
    """Statistics of the quantities of runs (``keep``: of these) over ``point``, at the nodes of each run.

    Those of the angle of a lower flex joint end with a disconnect, which opens the joint.
    """
    wide = keep and with_envelopes(keep)
    layouts = zip(*by_layout([*map(_until_release, results)], wide), strict=True)
    return as_variables([(of, of_runs(run)) for of, run in layouts])


def _until_release(result: Result) -> Result:
    """A run in which the angle of a lower flex joint is missing after a disconnect."""
    end, arrays = result.facts.get("lower_joint_until"), result.arrays
    if end is None or LOWER_ANGLE not in arrays or "time" not in arrays:
        return result
    joined = np.arange(len(arrays["time"])) < count_until(arrays["time"], end)
    angle = np.where(joined, arrays[LOWER_ANGLE], np.nan)
    return Result({**arrays, LOWER_ANGLE: angle}, result.facts)


def by_layout(
    results: list[Result], keep: Collection[str] | None
) -> tuple[list[list[int]], list[xr.Dataset]]:
    """Runs of each layout as one dataset of the quantities to keep (None: all), with their indices."""
    places = _layouts(results)
    runs = [_stacked([results[k] for k in of]) for of in places]
    if keep is not None:
        runs = [run[[name for name in keep if name in run]] for run in runs]
    return places, runs


def _stacked(results: list[Result]) -> xr.Dataset:
    """Runs of one layout as one dataset (a dataset for each run takes five times as long)."""
    import xarray as xr

    first = results[0].arrays
    data = {
        label: (("point", *dims), np.stack([result.arrays[name] for result in results]))
        for label, (dims, name) in quantities(first).items()
    }
    return xr.Dataset(data, coordinates(first))


def _on_common_nodes(results: list[Result]) -> list[Result]:
    """Runs interpolated to common nodes, if their meshes differ."""
    meshes = {result.arrays["s_node"].tobytes(): result.arrays["s_node"] for result in results}
    if len(meshes) < 2:
        return results
    nodes = common_nodes([*meshes.values()])
    return [laid_on(result, nodes) for result in results]


def laid_on(result: Result, nodes: NDArray[np.float64]) -> Result:
    """A run's nodal values interpolated to other places (m, shape (n,)), NaN above its top.

    At a node of the run, its value is used without interpolation, because a wall may end there.
    """
    own = result.arrays
    curve = curve_of(own)
    there = nodes <= own["s_node"][-1] + 10.0**-NODE_DIGITS
    places = np.minimum(nodes[there], own["s_node"][-1])
    nearest = np.searchsorted(0.5 * (own["s_node"][1:] + own["s_node"][:-1]), places)
    at_node = abs(own["s_node"][nearest] - places) <= 10.0**-NODE_DIGITS
    places = np.where(at_node, own["s_node"][nearest], places)
    everywhere = "time" in own and len(own["s"]) == len(own["s_node"])
    laid = at_stations(own, places) if everywhere and HISTORIES.intersection(own) else {}
    for name, values in own.items():
        if dimensions(name, values)[-1:] != ("s_node",) or name.startswith(UNLABELLED):
            continue
        if name == "damage_rate":
            laid[name] = between_nodes(own["s_node"], values, places)
        else:
            between = curve.straight if name.startswith("effective_tension") else curve.cubic
            laid[name] = between(values, places)
    for name in set(laid) - {"s"}:
        laid[name][..., at_node] = own[name][..., nearest[at_node]]
    whole = {}
    for name, values in laid.items():
        whole[name] = np.full((*values.shape[:-1], len(nodes)), np.nan)
        whole[name][..., there] = values
    if everywhere:
        whole["s"] = nodes
    return Result(own | whole | {"s_node": nodes}, result.facts)


def _add_sampled(dataset: xr.Dataset, study: Study) -> None:
    """Add the inputs that each sample assumes, as variables named assumed_...

    An assumption that every value of a later axis replaces is an input of no point, and is left out.
    """
    import xarray as xr

    for name, axis in study.model.axes.items():
        if not isinstance(axis, Samples):
            continue
        every = study.assumed(axis)
        samples = [every[number] for number, _ in study.axes[name]]
        axes = [*study.axes]
        later = [study.axes[other] for other in axes[axes.index(name) + 1 :]]
        for path in samples[0]:
            if path not in axis.readings and any(set_by_all(steps, path) for steps in later):
                continue
            values = [assumed[path] for assumed in samples]
            plain = [v if isinstance(v, int | float) else str(v) for v in values]
            label = "assumed_" + as_name(path)  # riser[0].mass: riser_0_mass
            dataset[label] = xr.DataArray(plain, dims=name, attrs={"long_name": path})


class Known(NamedTuple):
    """Summary of points: their number, the number with an estimated error, all effects, largest errors."""

    points: int
    estimated: int
    effects: dict[str, str]
    errors: dict[str, float]  # relative (1), by quantity


def known_of(results: list[Result]) -> Known:
    """Summary of points from their results."""
    estimated = sum(bool(result.facts.get("error_estimate")) for result in results)
    effects = {name: why for r in results for name, why in r.facts["effects"].items()}
    return Known(len(results), estimated, effects, largest_errors(results))


def joined(parts: list[Known]) -> Known:
    """Joint summary of the points of several parts."""
    effects = {name: why for part in parts for name, why in part.effects.items()}
    errors = {name: max(p.errors.get(name, 0.0) for p in parts) for p in parts for name in p.errors}
    return Known(sum(p.points for p in parts), sum(p.estimated for p in parts), effects, errors)


def attributes_of_points(known: Known) -> dict[str, str]:
    """Attributes of a dataset with the summary of its points."""
    estimated = f"{known.estimated} of {known.points} points, chosen by their keys"
    return {"effects": json.dumps(known.effects), "errors_estimated": estimated}


def _about(study: Study, results: list[Result]) -> dict[str, Any]:
    return {
        "Conventions": "CF-1.11",
        "title": titled(study.model.caption, study.paper, study.name),
        "paper": study.paper,
        "tier": study.tier,
        "digest": study.digest,
        **provenance_of_study(study.base, study.tables),
        **attributes_of_points(known_of(results)),
        **({"error_because": because} if (because := study.model.error_because) else {}),
        "history": history(f"simulated study {study.name} of {study.paper}, tier {study.tier}"),
    }
