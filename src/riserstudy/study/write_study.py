"""Write the dataset of a study: in one piece, or in parts for a big study, to limit the required memory.

The parts divide the longest axis. Each part is joined as a separate study, written, and removed from memory.
Then they are copied into the file of the whole study, one after the other. If parts differ in more than their
values, for example by nodes of different meshes, the whole study is joined in one piece.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping
from copy import copy
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import netCDF4

from riserstudy.dataset.netcdf import written_whole
from riserstudy.dataset.write_dataset import PACKED, ROUNDED, write_dataset
from riserstudy.study.collect import Known, attributes_of_points, dataset_of, joined, known_of, results_of
from riserstudy.study.limits import limited
from riserstudy.study.settings import Settings, dataset_tuned, with_setting
from riserstudy.study.simulate_points import Count
from riserstudy.study.study import Study

if TYPE_CHECKING:
    import xarray as xr

    from riserstudy.dataset.result import Result

AT_ONCE = 20_000  # largest number of points in memory
QUANTISED = "_QuantizeGranularBitRoundNumberOfSignificantDigits"  # written by the netCDF library


class Part(NamedTuple):
    """A part of a study: its values of the longest axis, and the summary of its points."""

    path: Path
    first: int
    last: int
    known: Known


def write_study(
    study: Study,
    target: Path,
    processes: int,
    notify: Callable[[str], None],
    count: Count | None = None,
    settings: Settings | None = None,
) -> None:
    """Simulate the missing points of a study, and write its dataset.

    Raises SimulationError when points cannot be completed, or the dataset cannot be written.

    Parameters
    ----------
    settings : tuned settings of the study, if it has them.
    notify : function that receives a sentence with the number of simulated points.
    count : function that is called for each completed point; absent: none.
    """
    tuned = with_setting(study, settings.setting) if settings and settings.setting else None

    def made(of: Study, as_tuned: Study | None, before: int | None) -> tuple[xr.Dataset, list[Result]]:
        def counted(done: int, _: int) -> None:
            if count and before is not None:
                count(before + done, len(study.grid))

        report = _ignore if before is None else notify
        if settings:
            return dataset_tuned(of, settings, as_tuned, processes, report, counted)
        results, _ = results_of(of, processes, report, counted)
        return dataset_of(of, results), results

    if len(study.grid) > AT_ONCE:
        if _join_in_parts(study, tuned, target, made):
            return
        differ = "points have different meshes or allowables"
        notify(f"{study.paper}/{study.name}: {differ} and are joined in one step")
    write_dataset(made(study, tuned, 0)[0], target)


#: function that returns the dataset of a study (of this study as tuned), and its results; it receives the
#: number of points that are already complete; None: all are, and nothing is reported
Made = Callable[[Study, Study | None, int | None], tuple["xr.Dataset", list["Result"]]]


def _ignore(_: str) -> None:
    """Receive a sentence about points that was already reported."""


def _join_in_parts(study: Study, tuned: Study | None, target: Path, made: Made) -> bool:
    """Write the dataset of a study from parts of it; False if they differ in more than their values.

    Verdicts depend on the largest errors of all points. If these are not known to each part, the parts are
    written again.
    """
    parts: list[Part] = []
    try:
        parts += _parts(study, tuned, target, made)
        errors = joined([part.known for part in parts]).errors
        if limited(study) and any(part.known.errors != errors for part in parts):
            parts = [*_parts(study, tuned, target, made, errors)]
        if not _alike(parts):
            return False
        axis = _longest(study)
        with written_whole(target) as partial:
            _take_in(parts, axis, len(study.axes[axis]), partial)
        return True
    finally:
        for part in parts:
            part.path.unlink(missing_ok=True)


def _longest(study: Study) -> str:
    return max(study.axes, key=lambda name: len(study.axes[name]))


def _parts(
    study: Study, tuned: Study | None, target: Path, made: Made, errors: Mapping[str, float] | None = None
) -> Iterator[Part]:
    """Write the parts of a study next to its dataset; ``errors``: the largest of the study, if known."""
    axis = _longest(study)
    length = len(study.axes[axis])
    many = max(1, AT_ONCE * length // len(study.grid))
    before = 0
    for first in range(0, length, many):
        last = min(first + many, length)
        part = _part_of(study, axis, first, last, errors)
        as_tuned = _part_of(tuned, axis, first, last, errors) if tuned else None
        dataset, results = made(part, as_tuned, before if errors is None else None)
        before += len(results)
        path = target.with_name(f".{target.name}.{os.getpid()}.{first}")
        write_dataset(dataset, path)
        yield Part(path, first, last, known_of(results))


def _part_of(study: Study, axis: str, first: int, last: int, errors: Mapping[str, float] | None) -> Study:
    """A study with some values of one axis, whose points are points of the whole study."""
    number = list(study.axes).index(axis)
    plan = [point for point in study.plan if first <= point.index[number] < last]
    of_whole = {"grid": study.grid, "end_keys": study.end_keys, "digest": study.digest}
    part = copy(study)
    held = vars(part)  # cached properties, and a field
    held.update(of_whole, plan=plan, largest_errors=errors)
    held["axes"] = study.axes | {axis: study.axes[axis][first:last]}
    return part


def _alike(parts: list[Part]) -> bool:
    """Whether all parts have the same variables over the same coordinates, except for the divided axis.

    Limits in the attributes, with allowables that are equal at all points of a part, must be the same.
    """
    shapes = set()
    for part in parts:
        with netCDF4.Dataset(part.path) as file:
            file.set_auto_maskandscale(False)
            variables = (
                (name, of.dimensions, str(of.dtype), _over(file, name)) for name, of in file.variables.items()
            )
            shapes.add((*variables, file.getncattr("limits") if "limits" in file.ncattrs() else ""))
    return len(shapes) == 1


def _over(file: netCDF4.Dataset, name: str) -> tuple[Any, ...]:
    """Values of a coordinate over a dimension of runs; empty for other variables."""
    axes = file["point_key"].dimensions
    if file[name].dimensions != (name,) or name in axes:
        return ()
    return tuple(file[name][:].tolist())


def _take_in(parts: list[Part], axis: str, length: int, target: Path) -> None:
    """Write one file from several parts of the same form, along an axis with ``length`` values."""
    with netCDF4.Dataset(parts[0].path) as like, netCDF4.Dataset(target, "w") as whole:
        like.set_auto_maskandscale(False)
        for name, dimension in like.dimensions.items():
            whole.createDimension(name, length if name == axis else len(dimension))
        rounded = _rounded(parts)
        for name, of in like.variables.items():
            _declare(whole, name, of, name in rounded)
        about = {name: like.getncattr(name) for name in like.ncattrs()}
        whole.setncatts(about | attributes_of_points(joined([part.known for part in parts])))
        whole.set_auto_maskandscale(False)
        sets: dict[str, Any] = {}
        for part in parts:
            with netCDF4.Dataset(part.path) as file:
                file.set_auto_maskandscale(False)
                for name, of in file.variables.items():
                    if axis in of.dimensions:
                        place = [slice(None)] * of.ndim
                        place[of.dimensions.index(axis)] = slice(part.first, part.last)
                        whole[name][tuple(place)] = of[...]
                    elif part is parts[0]:
                        whole[name][...] = of[...]
                sets |= json.loads(file[axis].getncattr("sets"))
        whole[axis].setncattr("sets", json.dumps(sets))


def _rounded(parts: list[Part]) -> set[str]:
    """Names of the variables that are rounded in every part."""
    found = []
    for part in parts:
        with netCDF4.Dataset(part.path) as file:
            found.append({n for n, of in file.variables.items() if QUANTISED in of.ncattrs()})
    return set.intersection(*found)


def _declare(whole: netCDF4.Dataset, name: str, like: netCDF4.Variable[Any], rounded: bool) -> None:
    """Create a variable with the type and attributes of another."""
    about = {n: like.getncattr(n) for n in like.ncattrs() if n != QUANTISED}
    empty = about.pop("_FillValue", None)
    packed: dict[str, Any] = {}
    if (like.filters() or {}).get("zlib"):
        packed = PACKED | (ROUNDED if rounded else {})
    made = whole.createVariable(name, like.dtype, like.dimensions, fill_value=empty, **packed)
    made.setncatts(about)
