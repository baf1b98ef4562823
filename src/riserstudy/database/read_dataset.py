"""A dataset as grids of cells, each with plain values and with arrays over a run.

Read by the netCDF library itself: to label every array takes longer than to read it.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np
from numpy.typing import NDArray

from riserstudy.errors import InputError

OF_A_RUN = ("time", "s", "s_node", "cylinder")  # dimensions that are no axes of a grid


class Variable(NamedTuple):
    """Values over (cells, and dimensions of a run), in their order, with what the file says of them."""

    name: str
    values: NDArray[Any]
    within: tuple[str, ...]
    unit: str | None
    long_name: str | None


@dataclass(frozen=True)
class Axis:
    """Values of a dimension of a grid; ``sets`` says by value what each sets in the scene."""

    name: str
    values: list[Any]
    unit: str | None
    long_name: str | None
    sets: str | None


@dataclass(frozen=True)
class Grid:
    """Cells over some axes, the last fastest."""

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
        """Values of an axis at all cells."""
        inner = math.prod(self.shape[number + 1 :])
        outer = math.prod(self.shape[:number])
        return [value for value in self.axes[number].values for _ in range(inner)] * outer


@dataclass(frozen=True)
class Contents:
    """What a dataset holds: attributes, coordinates of runs, and its grids, the main one first."""

    attributes: dict[str, Any]
    coordinates: dict[str, NDArray[Any]]
    grids: list[Grid]


def read_dataset(path: Path) -> Contents:
    """Everything but histories whose extremes are there.

    Raises
    ------
    InputError
        When it cannot be read.
    """
    try:
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            attributes = {name: file.getncattr(name) for name in file.ncattrs()}
            coordinates = {n: file[n][:] for n in OF_A_RUN if n in file.variables}
            return Contents(attributes, coordinates, [*_grids(file)])
    except (OSError, RuntimeError) as error:  # the library's own errors are of the latter kind
        found = f"no whole dataset ({error})"
        raise InputError(path, "", found, "delete it; the next run makes it anew") from None


def _grids(file: netCDF4.Dataset) -> Iterator[Grid]:
    """One grid over the axes of most variables, others for those that vary over something else.

    Of a simulated study the main grid is that of its points.
    """
    wanted = [v for name, v in file.variables.items() if name not in file.dimensions]
    wanted = [v for v in wanted if not _in_other_variables(v.name, v.dimensions, file.variables)]
    every = [tuple(d for d in v.dimensions if d not in OF_A_RUN) for v in wanted]
    spans = [dims for dims in every if not any(set(dims) < set(other) for other in every)]
    counts = Counter(tuple(sorted(dims)) for dims in spans)
    order = sorted(counts, key=lambda dims: -counts[dims])
    if "point_key" in file.variables:
        points = tuple(sorted(file["point_key"].dimensions))
        order = [points, *(dims for dims in order if dims != points)]
    left = [*wanted]
    for dims in order:
        mine = [v for v in left if set(v.dimensions).difference(OF_A_RUN) <= set(dims)]
        left = [v for v in left if v not in mine]
        spanning = (tuple(d for d in v.dimensions if d in dims) for v in mine)
        axes = next(own for own in spanning if set(own) == set(dims))
        yield Grid([_axis(file, name) for name in axes], [_variable(file, v, axes) for v in mine])


def _in_other_variables(name: str, dims: tuple[str, ...], others: dict[str, Any]) -> bool:
    """Whether an array is large and its extremes stand beside it, or is there under another name."""
    if "time" in dims:
        return "s" in dims and f"{name}_max" in others and f"{name}_min" in others
    if not set(dims) & set(OF_A_RUN):
        return False
    short = name.removesuffix("_static")
    return short != name and short in others and "time" not in others[short].dimensions


def _axis(file: netCDF4.Dataset, name: str) -> Axis:
    if name not in file.variables:
        return Axis(name, [*range(len(file.dimensions[name]))], None, None, None)
    of = file[name]
    return Axis(name, of[:].tolist(), *(_attribute(of, n) for n in ("units", "long_name", "sets")))


def _attribute(of: Any, name: str) -> str | None:
    return str(of.getncattr(name)) if name in of.ncattrs() else None


def _variable(file: netCDF4.Dataset, of: Any, axes: tuple[str, ...]) -> Variable:
    """A variable with the axes of its grid first, the same along those that it does not vary over."""
    within = tuple(d for d in of.dimensions if d in OF_A_RUN)
    own = [d for d in axes if d in of.dimensions]
    values = np.asarray(of[...]).transpose([of.dimensions.index(d) for d in (*own, *within)])
    sizes = [len(file.dimensions[d]) for d in axes]
    inner = values.shape[len(own) :]
    spread = [size if d in own else 1 for d, size in zip(axes, sizes, strict=True)]
    values = np.broadcast_to(values.reshape((*spread, *inner)), (*sizes, *inner))
    flat = values.reshape((math.prod(sizes), *inner))
    return Variable(of.name, flat, within, _attribute(of, "units"), _attribute(of, "long_name"))
