"""Functions for all plots that fit any grid: axes of a dataset, a few of its points, values with labels."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import product
from textwrap import fill

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from riserstudy.dataset.extremes import OF_A_RUN, largest_size, statistic_of
from riserstudy.dataset.unit_systems import read_in
from riserstudy.dataset.variables import attributes
from riserstudy.errors import InputError
from riserstudy.figures.names import in_words
from riserstudy.figures.style import key_below, panels
from riserstudy.figures.until_a_disconnect import limits_of_all_times
from riserstudy.scene.limits import OF_THE_RISER, SIGNED

#: dimensions that are not axes of the grid
MOST = 7  # largest number of separate curves or panels
ENDINGS = ("_max", "_min")
SIZE = "_absmax"  # ending for the largest magnitude
#: extremes of the riser alone, as for its limits: without stack, conductor and telescopic joint
SMALLEST_OF_THE_RISER = {"effective_tension_min": "smallest_tension"}
OF_SIDES = {"_max": "largest", "_min": "smallest"}  # sides of the limits on an extreme, by its ending
CHARACTERS = 14.0  # characters of a legend in an inch
WRAPPED = 36  # number of characters beyond which a label continues on the next line
LINE = 0.2  # height of a line of a legend (inches)


def axes_of(dataset: xr.Dataset) -> list[str]:
    """Axes of the grid, in the order of the study."""
    dims = dataset["point_key"].dims if "point_key" in dataset else dataset.sizes
    return [str(dim) for dim in dims if dim not in OF_A_RUN]


def along(dataset: xr.Dataset, count: int) -> list[str]:
    """The axes to plot over: axes with the most numbers first, then others."""

    def rank(axis: str) -> tuple[bool, int]:
        return dataset[axis].dtype.kind == "f", dataset.sizes[axis]

    return sorted(axes_of(dataset), key=rank, reverse=True)[:count]


def evenly_spaced(count: int, most: int) -> NDArray[np.int64]:
    """At most ``most`` indices of a row with ``count`` items, with both ends."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(np.int64))


def points(dataset: xr.Dataset, over: Sequence[str] = ()) -> list[tuple[str, xr.Dataset]]:
    """A few equally spaced points of the grid, with their names; axes in ``over`` are kept."""
    axes = [axis for axis in axes_of(dataset) if axis not in over]
    places = list(product(*(range(dataset.sizes[axis]) for axis in axes)))
    selected = []
    for k in evenly_spaced(len(places), MOST):
        point = dataset.isel(dict(zip(axes, places[k], strict=True)))
        selected.append((", ".join(called(point[axis]) for axis in axes), point))
    return selected


def called(value: xr.DataArray) -> str:
    """One value of an axis, with the axis's name and unit: ``mud weight 1800 kg/m³``."""
    name = in_words(str(value.name))
    if value.dtype.kind not in "fiu":
        label = str(value.item())
        return f"{name} {label}" if label.isdigit() else label
    factor, unit = read_in(about(value).get("units", ""))
    return f"{name} {factor * value.item():.4g}" + ("" if unit in ("", "1") else f" {unit}")


def extreme(dataset: xr.Dataset, name: str) -> xr.DataArray:
    """A quantity as one number per point; endings of the name select the extreme over riser and time.

    Raises InputError when the dataset has no such quantity.
    """
    if (alone := SMALLEST_OF_THE_RISER.get(name)) in dataset:
        return dataset[alone].rename(name).assign_attrs(attributes(str(alone)))
    ending = next((e for e in (*ENDINGS, SIZE) if name.endswith(e)), "")
    of, statistic = name.removesuffix(ending), ending.removeprefix("_") or "max"
    if (limited := _of_the_riser(dataset, of, ending)) is not None:
        return limited.rename(name).assign_attrs(attributes(name))
    own = largest_size(dataset, of) if ending == SIZE else statistic_of(dataset, of, statistic)
    if own is not None:  # from each run's nodes, before interpolation to common nodes
        return own.rename(name).assign_attrs(attributes(name))
    values = dataset.get(name, dataset.get(name.removesuffix(ending)))
    if ending == SIZE and name not in dataset:
        values = _size(dataset, name.removesuffix(SIZE))
    if values is None or values.dtype.kind not in "fiu":
        raise absent(dataset, name.removesuffix(ending))
    within = [dim for dim in values.dims if dim in OF_A_RUN]
    reduced: xr.DataArray = values.min(within) if ending == "_min" else values.max(within)
    return reduced.rename(name).assign_attrs(attributes(name) or values.attrs)


def _of_the_riser(dataset: xr.Dataset, quantity: str, ending: str) -> xr.DataArray | None:
    """The demand of a limit that applies to the riser alone; None if the dataset has no such limit.

    An extreme with stack and conductor would not agree with the verdicts on this limit. The demand of a limit
    that ends with a disconnect is not the extreme of the run.
    """
    if quantity not in OF_THE_RISER or "demand_of_limit" not in dataset:
        return None
    for k, row in limits_of_all_times(dataset):
        if (row["output"], row["side"], row["at"]) == (quantity, OF_SIDES.get(ending), ""):
            return dataset["demand_of_limit"].isel(limit=k, drop=True)
    return None


def _size(dataset: xr.Dataset, name: str) -> xr.DataArray | None:
    """Magnitude of a quantity, from its history or its extremes; None if there is neither."""
    sides = [n for n in (name, *(name + end for end in ENDINGS)) if n in dataset]
    if not sides or dataset[sides[0]].dtype.kind not in "fiu":
        return None
    of = [abs(dataset[side]) for side in sides]
    return of[0] if sides[0] == name else xr.concat(of, "side").max("side")


def absent(dataset: xr.Dataset, name: str) -> InputError:
    """The error for a requested quantity that does not exist."""
    there = ", ".join(sorted(str(n) for n, v in dataset.items() if v.dtype.kind == "f"))
    title = str(dataset.attrs.get("title", "dataset"))
    return InputError(title, "of", f"the dataset has no {name!r}", f"use one of {there}")


def present(dataset: xr.Dataset, names: Iterable[str]) -> list[str]:
    """The quantities that the dataset has, as histories or as extremes.

    Raises InputError when it has none of them.
    """
    wanted = list(names)
    ends = ("", *ENDINGS, SIZE)
    there = [name for name in wanted if {name + end for end in ends} & set(dataset)]
    if not there:
        raise absent(dataset, wanted[0])
    return there


def about(values: xr.DataArray) -> dict[str, str]:
    """Attributes of a quantity: from the dataset, else from the file of variables."""
    return attributes(str(values.name)) | values.attrs


def read(values: xr.DataArray) -> xr.DataArray:
    """Values in the reader's unit."""
    if values.dtype.kind not in "fiu":
        return values
    return read_in(about(values).get("units", "")).factor * values


def label(values: xr.DataArray) -> str:
    """Label of an axis: long name, and the reader's unit unless it has words."""
    unit = about(values).get("units", "")
    name = about(values).get("long_name", in_words(str(values.name)))
    if values.dtype.kind not in "fiu":
        return name
    unit = "-" if unit in ("", "1") else read_in(unit).unit
    unit = unit.replace(" ", "\0")  # so that it is not wrapped
    return fill(f"{name} ({unit})", WRAPPED).replace("\0", " ")


def varies_within(dataset: xr.Dataset, name: str) -> bool:
    """Whether a quantity has many values per point, so that its extremes are relevant."""
    if name in dataset:
        return any(dim in OF_A_RUN for dim in dataset[name].dims)
    return not name.endswith((*ENDINGS, SIZE))


def ends_of(dataset: xr.Dataset, name: str) -> list[str]:
    """The most relevant extremes of a quantity: its magnitude if the sign is a convention."""
    if not varies_within(dataset, name):
        return [name]
    return [name + SIZE] if name in SIGNED else [name + end for end in ENDINGS]


def laid_out(count: int) -> tuple[Figure, list[Axes]]:
    """Empty figure with ``count`` panels, two per row."""
    columns = min(2, count)
    figure, axes = panels(-(-count // columns), columns, 3.2)
    for ax in axes[count:]:
        ax.remove()
    return figure, axes[:count]


def places_of(axis: xr.DataArray, set_ticks: Callable[..., object]) -> NDArray[np.float64]:
    """Positions of the values of an axis: the numbers, or successive positions for words."""
    if axis.dtype.kind in "fiu":
        return np.asarray(read(axis).values, float)
    places = np.arange(axis.size, dtype=float)
    set_ticks(places, [str(value) for value in axis.values])
    return places


def key(figure: Figure, ax: Axes) -> None:
    """Legend below the panels, with as many columns as fit; none for a single curve."""
    words = [word for word in ax.get_legend_handles_labels()[1] if word]
    if words:
        width, height = figure.get_size_inches()
        columns = max(1, int(width * CHARACTERS // (max(map(len, words)) + 6)))
        figure.set_size_inches(width, height + LINE * -(-len(words) // columns))
        key_below(figure, ax, columns)
