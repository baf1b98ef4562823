"""Read a dataset as grids of cells, with single values and with statistics of arrays over a run.

It is read with the netCDF library itself: labelling every array would take longer than reading it.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np

from riserstudy.dataset.extremes import (
    NAMES,
    OF_A_RUN,
    OVER,
    WHERE,
    Statistic,
    Variable,
    elsewhere,
    from_arrays,
    without_repeats,
)
from riserstudy.dataset.other_files import refuse_other_files
from riserstudy.errors import InputError

#: dimension of mode shapes, which only datasets contain: the database would need too many rows for them
SHAPED = "s_relative"
#: variables whose grid is the main grid
MAIN = ("point_key", "workable")


@dataclass(frozen=True)
class Axis:
    """Values of a dimension of a grid; ``sets`` contains, by value, what each sets in the scene."""

    name: str
    values: list[Any]
    unit: str | None
    long_name: str | None
    sets: str | None


@dataclass(frozen=True)
class Grid:
    """Cells over some axes; the last axis varies fastest."""

    axes: list[Axis]
    variables: list[Variable]

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of each axis."""
        return tuple(len(axis.values) for axis in self.axes)

    @property
    def cells(self) -> int:
        """Number of cells."""
        return math.prod(self.shape)

    def along(self, number: int) -> list[Any]:
        """Return the values of an axis at all cells."""
        inner = math.prod(self.shape[number + 1 :])
        outer = math.prod(self.shape[:number])
        return [value for value in self.axes[number].values for _ in range(inner)] * outer


@dataclass(frozen=True)
class Contents:
    """Contents of a dataset: attributes, and its grids with their statistics, the main grid first."""

    attributes: dict[str, Any]
    grids: list[tuple[Grid, list[Statistic]]]


def read_dataset(path: Path) -> Contents:
    """Read a dataset, except arrays over runs whose statistics it contains.

    Raises InputError when the file cannot be read.
    """
    refuse_other_files(path)
    try:
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            attributes = {name: file.getncattr(name) for name in file.ncattrs()}
            coordinates = {n: file[n][:] for n in WHERE if n in file.variables}
            grids = [(grid, [*without_repeats(grid.variables, coordinates)]) for grid in _grids(file)]
            grids[0][1].extend(_statistics(file, grids[0][0]))
            return Contents(attributes, grids)
    except (OSError, RuntimeError, MemoryError) as error:  # the library's own are RuntimeErrors
        found = f"the dataset is incomplete ({error})"
        raise InputError(path, "", found, "delete it; the next `make study` writes it again") from None


def _grids(file: netCDF4.Dataset) -> Iterator[Grid]:
    """Yield the grid over the axes of most variables, then grids of variables over other axes.

    The main grid of a simulated study contains its points; for the hours of a record it contains settings and
    modes.
    """
    dims_of = {name: v.dimensions for name, v in file.variables.items()}
    wanted = [
        v
        for name, v in file.variables.items()
        if name not in file.dimensions and not _is_reported(name, dims_of) and SHAPED not in v.dimensions
    ]
    every = [tuple(d for d in v.dimensions if d not in OF_A_RUN) for v in wanted]
    spans = [dims for dims in every if not any(set(dims) < set(other) for other in every)]
    counts = Counter(tuple(sorted(dims)) for dims in spans)
    order = sorted(counts, key=lambda dims: -counts[dims])
    if main := next((name for name in MAIN if name in file.variables), None):
        points = tuple(sorted(file[main].dimensions))
        order = [points, *(dims for dims in order if dims != points)]
    left = [*wanted]
    for dims in order:
        mine = [v for v in left if set(v.dimensions).difference(OF_A_RUN) <= set(dims)]
        left = [v for v in left if v not in mine]
        spanning = (tuple(d for d in v.dimensions if d in dims) for v in mine)
        axes = next(own for own in spanning if set(own) == set(dims))
        yield Grid([_axis(file, name) for name in axes], [_variable(file, v, axes) for v in mine])


def _is_reported(name: str, dims_of: dict[str, tuple[str, ...]]) -> bool:
    """Return whether statistics replace a variable, or it is itself a statistic."""
    dims = dims_of[name]
    if NAMES["value"] in dims_of:
        return OVER in dims or not set(dims).isdisjoint(OF_A_RUN)
    return elsewhere(name, dims, dims_of)


def _statistics(file: netCDF4.Dataset, grid: Grid) -> Iterator[Statistic]:
    """Yield the statistics that a study calculated from its runs."""
    if NAMES["value"] in file.variables:
        held = {kind: file[name][...] for kind, name in NAMES.items() if name in file.variables}
        count = len(file.dimensions[OVER])
        flat = {kind: values.reshape(grid.cells, count) for kind, values in held.items()}
        yield from from_arrays(file[OVER][:].tolist(), flat)


def _axis(file: netCDF4.Dataset, name: str) -> Axis:
    if name not in file.variables:
        return Axis(name, [*range(len(file.dimensions[name]))], None, None, None)
    of = file[name]
    return Axis(name, of[:].tolist(), *(_attribute(of, n) for n in ("units", "long_name", "sets")))


def _attribute(of: Any, name: str) -> str | None:
    return str(of.getncattr(name)) if name in of.ncattrs() else None


def _variable(file: netCDF4.Dataset, of: Any, axes: tuple[str, ...]) -> Variable:
    """Return a variable with the axes of its grid first; it is repeated along axes that it lacks."""
    within = tuple(d for d in of.dimensions if d in OF_A_RUN)
    own = [d for d in axes if d in of.dimensions]
    values = np.asarray(of[...]).transpose([of.dimensions.index(d) for d in (*own, *within)])
    sizes = [len(file.dimensions[d]) for d in axes]
    inner = values.shape[len(own) :]
    spread = [size if d in own else 1 for d, size in zip(axes, sizes, strict=True)]
    values = np.broadcast_to(values.reshape((*spread, *inner)), (*sizes, *inner))
    flat = values.reshape((math.prod(sizes), *inner))
    return Variable(of.name, flat, within, _attribute(of, "units"), _attribute(of, "long_name"))
