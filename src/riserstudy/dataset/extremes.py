"""Statistics of arrays over a run: extremes with place and time, amplitude, last value.

Every value except an amplitude is a value of the array, bit for bit. A study computes them for each run at
the nodes of this run, before any rounding. A point therefore has the same statistics in all studies.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.variables import attributes, cf_unit
from riserstudy.records.arrays import FloatArray

if TYPE_CHECKING:
    import xarray as xr

ENDINGS = {"_absmax": "absmax", "_max": "max", "_min": "min", "_static": "static"}
WHERE = {"s_node": "s", "s": "s", "time": "time", "cylinder": "cylinder"}


OF_ENVELOPES = {"max": np.positive, "min": np.negative, "absmax": np.abs}  # largest at the extreme
# dimension of a dataset with one entry for each statistic, as "bending_moment max"
OVER = "statistic"
#: dimensions that are not axes of a grid
OF_A_RUN = ("time", "s", "s_node", "cylinder", "detail", "wall_angle")
NAMES = {kind: f"{kind}_of_statistic" for kind in ("value", *dict.fromkeys(WHERE.values()))}


class Variable(NamedTuple):
    """Values over (cells, and dimensions of a run), in this order, with their attributes."""

    name: str
    values: NDArray[Any]
    within: tuple[str, ...]
    unit: str | None
    long_name: str | None


class Statistic(NamedTuple):
    """One statistic of a quantity at all cells, NaN for cells without it. ``at``: its s, time, cylinder."""

    quantity: str
    statistic: str
    unit: str | None
    long_name: str | None
    values: NDArray[Any]
    at: dict[str, FloatArray]


def elsewhere(name: str, dims: Collection[str], others: Mapping[str, Collection[str]]) -> bool:
    """Whether other arrays, given by name with their dimensions, already have the statistics of an array."""
    if "time" in dims:
        return "s" in dims and f"{name}_max" in others and f"{name}_min" in others
    if not set(dims) & set(OF_A_RUN):
        return False
    short = name.removesuffix("_static")
    return short != name and short in others and "time" not in others[short]


def without_repeats(
    variables: Sequence[Variable], coordinates: Mapping[str, NDArray[Any]]
) -> Iterator[Statistic]:
    """Statistics of variables, without those of a history that an envelope over all steps also gives.

    ``coordinates``: coordinates of the dimensions of a run, each (n,).
    """
    names = {variable.name for variable in variables}
    for variable in variables:
        for one in _statistics_of(variable, coordinates):
            if f"{variable.name}_{one.statistic}" not in names:
                yield one


def of_runs(runs: xr.Dataset) -> list[Statistic]:
    """Statistics of arrays of runs on the same mesh, over ``point``."""
    dims = {str(name): tuple(map(str, of.dims[1:])) for name, of in runs.data_vars.items()}
    variables = [
        Variable(name, runs[name].values, within, None, None)
        for name, within in dims.items()
        if within and not elsewhere(name, within, dims)
    ]
    coordinates = {name: runs[name].values for name in WHERE if name in runs.coords}
    return [_timed(of, runs) for of in without_repeats(variables, coordinates)]


def _timed(of: Statistic, runs: xr.Dataset) -> Statistic:
    """An extreme of an envelope with the time of the nearest output, if all nodes have histories."""
    if of.statistic not in OF_ENVELOPES or "time" in of.at or of.quantity not in runs:
        return of
    history = runs[of.quantity]
    if history.dims[1:] != ("time", "s") or runs["s"].size != runs["s_node"].size:
        return of
    node = np.searchsorted(runs["s_node"], of.at["s"]).clip(max=runs["s"].size - 1)
    there = OF_ENVELOPES[of.statistic](history.values[np.arange(len(node)), :, node])
    times = np.where(np.isnan(of.values), np.nan, runs["time"].values[there.argmax(axis=1)])
    return of._replace(at=of.at | {"time": times})


def as_variables(parts: Sequence[tuple[Sequence[int], list[Statistic]]]) -> dict[str, Any]:
    """Statistics of several groups of runs as variables over (point, statistic), with this coordinate.

    ``parts``: indices of the runs of each group, and their statistics.
    """
    count = sum(len(places) for places, _ in parts)
    labels = dict.fromkeys(f"{of.quantity} {of.statistic}" for _, statistics in parts for of in statistics)
    columns = {label: k for k, label in enumerate(labels)}
    data = {kind: np.full((count, len(labels)), np.nan) for kind in NAMES}
    for places, statistics in parts:
        for of in statistics:
            k = columns[f"{of.quantity} {of.statistic}"]
            for kind, values in {"value": of.values, **of.at}.items():
                data[kind][places, k] = values
    if not labels:
        return {}
    some = {kind: values for kind, values in data.items() if not np.isnan(values).all()}
    over = ("point", OVER)
    named = {NAMES[kind]: (over, values, attributes(NAMES[kind])) for kind, values in some.items()}
    return named | {OVER: (OVER, [*labels], attributes(OVER))}


def from_arrays(labels: Sequence[str], held: Mapping[str, NDArray[Any]]) -> Iterator[Statistic]:
    """Statistics from the variables of a dataset.

    ``held``: variables by their kinds, (n, k) for n cells and k labels.
    """
    for k, label in enumerate(labels):
        quantity, statistic = label.split(" ")
        about = attributes(f"{quantity}_{statistic.partition('_')[0]}") or attributes(quantity)
        at = {kind: values[:, k] for kind, values in held.items() if kind != "value"}
        unit, name = cf_unit(about.get("units", "")) or None, about.get("long_name")
        yield Statistic(quantity, statistic, unit, name, held["value"][:, k], at)


def statistic_of(dataset: xr.Dataset, quantity: str, statistic: str) -> xr.DataArray | None:
    """A statistic of a study's runs, over its axes; None if the study does not have it."""
    label = f"{quantity} {statistic}"
    if NAMES["value"] not in dataset or label not in dataset[OVER]:
        return None
    return dataset[NAMES["value"]].sel({OVER: label}, drop=True)


def largest_size(dataset: xr.Dataset, quantity: str) -> xr.DataArray | None:
    """Largest magnitude of a quantity in a study's runs; None if the study does not have it."""
    sides = [statistic_of(dataset, quantity, side) for side in ("max", "min")]
    if sides[0] is None or sides[1] is None:
        return statistic_of(dataset, quantity, "absmax")
    return abs(sides[0]).where(abs(sides[0]) >= abs(sides[1]), abs(sides[1]))


def _statistics_of(variable: Variable, coordinates: Mapping[str, NDArray[Any]]) -> Iterator[Statistic]:
    """Statistics of a variable: its value, or the statistics that represent an array."""
    quantity, kind = _split(variable.name)
    common = (variable.unit, variable.long_name)
    if not variable.within:
        yield Statistic(quantity, kind or "value", *common, variable.values, {})
        return
    if variable.values.dtype.kind not in "fiu" or 0 in variable.values.shape:
        return
    if kind in ("max", "absmax"):
        yield Statistic(quantity, kind, *common, *_extreme(variable, coordinates, 1.0))
        return
    if kind == "min":
        yield Statistic(quantity, kind, *common, *_extreme(variable, coordinates, -1.0))
        return
    before = f"{kind}_" if kind else ""
    largest = _extreme(variable, coordinates, 1.0)
    smallest = _extreme(variable, coordinates, -1.0)
    yield Statistic(quantity, f"{before}max", *common, *largest)
    yield Statistic(quantity, f"{before}min", *common, *smallest)
    if variable.within == ("time",):
        yield Statistic(quantity, "amplitude", *common, (largest[0] - smallest[0]) / 2.0, {})
        yield Statistic(quantity, "last", *common, variable.values[:, -1], {})


def _split(name: str) -> tuple[str, str]:
    """Quantity and kind of a variable, from the ending of its name."""
    for ending, kind in ENDINGS.items():
        if name.endswith(ending) and name != ending:
            return name.removesuffix(ending), kind
    return name, ""


def _extreme(
    variable: Variable, coordinates: Mapping[str, NDArray[Any]], sign: float
) -> tuple[FloatArray, dict[str, FloatArray]]:
    """The largest value (the smallest for a sign of -1) of each cell, and its place."""
    inner = variable.values.shape[1:]
    values = variable.values.reshape(len(variable.values), -1).astype(np.float64, copy=False)
    if np.isnan(values).any():
        index = np.where(np.isnan(values), -np.inf, sign * values).argmax(axis=1)
    else:  # without a copy, since the array may be large
        index = values.argmax(axis=1) if sign > 0.0 else values.argmin(axis=1)
    extreme = values[np.arange(len(values)), index]
    at = {}
    for name, place in zip(variable.within, np.unravel_index(index, inner), strict=True):
        if name in coordinates:
            at[WHERE[name]] = np.where(np.isnan(extreme), np.nan, coordinates[name][place])
    return extreme, at
