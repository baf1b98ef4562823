"""Statistics of an array over a run: extremes with place and time, amplitude, last value.

Every value but an amplitude is one that stands in the array, bit by bit.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.database.read_dataset import Variable

Numbers = NDArray[np.float64]
ENDINGS = {"_absmax": "absmax", "_max": "max", "_min": "min", "_static": "static"}
WHERE = {"s_node": "s", "s": "s", "time": "time", "cylinder": "cylinder"}


class Statistic(NamedTuple):
    """One statistic of a quantity at all cells; NaN where there is none. ``at``: its s, time, cylinder."""

    quantity: str
    statistic: str
    unit: str | None
    long_name: str | None
    values: NDArray[Any]
    at: dict[str, Numbers]


def statistics_of(
    variable: Variable, coordinates: Mapping[str, NDArray[Any]]
) -> Iterator[Statistic]:
    """Statistics of a variable: its value, or what stands for an array."""
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
    """Quantity and kind of a variable, by how its name ends."""
    for ending, kind in ENDINGS.items():
        if name.endswith(ending) and name != ending:
            return name.removesuffix(ending), kind
    return name, ""


def _extreme(
    variable: Variable, coordinates: Mapping[str, NDArray[Any]], sign: float
) -> tuple[Numbers, dict[str, Numbers]]:
    """The largest value (the smallest for a sign of -1) of each cell, and where it is."""
    inner = variable.values.shape[1:]
    values = variable.values.reshape(len(variable.values), -1).astype(np.float64, copy=False)
    if np.isnan(values).any():
        index = np.where(np.isnan(values), -np.inf, sign * values).argmax(axis=1)
    else:  # without a copy of what may be large
        index = values.argmax(axis=1) if sign > 0.0 else values.argmin(axis=1)
    extreme = values[np.arange(len(values)), index]
    at = {}
    for name, place in zip(variable.within, np.unravel_index(index, inner), strict=True):
        if name in coordinates:
            at[WHERE[name]] = np.where(np.isnan(extreme), np.nan, coordinates[name][place])
    return extreme, at
