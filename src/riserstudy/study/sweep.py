"""A scene over a grid in one call from Python, with the points, store and datasets of studies.

A point that cannot be completed does not stop the others: the dataset has NaN for this point, and the reason.
"""

from __future__ import annotations

import re
import sys
import time
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from riserstudy.dataset.extremes import OF_A_RUN
from riserstudy.dataset.result import Result
from riserstudy.errors import InputError, SimulationError
from riserstudy.inputs.validate import check
from riserstudy.records.numerals import duration
from riserstudy.records.warning import sentence
from riserstudy.records.words import counted
from riserstudy.scene.fields import in_si
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.scene.paths import as_name, value_at
from riserstudy.scene.units import UnitFault, factor
from riserstudy.simulation.compile import available_cores
from riserstudy.study import store
from riserstudy.study.collect import dataset_of
from riserstudy.study.far_values import far_values
from riserstudy.study.grid import Point
from riserstudy.study.idle_values import idle_values
from riserstudy.study.processes import check_cores
from riserstudy.study.simulate_points import attempt
from riserstudy.study.study import Study
from riserstudy.study.study_model import StudyModel

if TYPE_CHECKING:
    from collections.abc import Iterator

    import xarray as xr

Values = Sequence[float | int | str]
Labelled = Mapping[str, Mapping[str, Any]]

#: a number with its unit
_QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([^\s\d].*?)\s*")
EVERY = 5.0  # interval of progress lines (s)
# arrays that say where and when, of points without numbers too
KEPT = frozenset((*OF_A_RUN, "mesh_corner"))


@dataclass(frozen=True)
class Sweep(Study):
    """A study of a given scene, not of a file below a configuration."""

    file: SceneFile = field(kw_only=True)

    @property
    def base(self) -> SceneFile:
        """The scene."""
        return self.file

    @property
    def where(self) -> str:
        """Name of the sweep in errors."""
        return "sweep"


def sweep(
    scene: SceneFile | str | Path,
    axes: Mapping[str, Values | Labelled],
    keep: Iterable[str] | None = None,
    *,
    modes: int | None = None,
    on_error: Literal["nan", "raise"] = "nan",
    cores: int | None = None,
    progress: bool = True,
) -> xr.Dataset:
    """Simulate a scene at all points of a grid, on all cores. Points in the store are not simulated again.

    Parameters
    ----------
    scene : SceneFile or str or Path
        A scene from :func:`riserstudy.load_scene`, or the path of its file.
    axes : mapping
        Values for a path of the scene, such as ``{"platform.surge.period": [8, 10, 12]}``. A number has the
        unit that the scene uses at this path; a text such as ``"1600 kN"`` has its own unit. A value that is
        100 times the value of the scene, or a hundredth of it, may cause a warning. The name of the
        dimension is the path with ``_`` instead of dots. An axis can also have a name, with labels and the
        values that each label sets, such as ``{"law": {"stiff": {"top.x": "held"}}}``.
    keep : iterable of str, optional
        Variables to keep, such as ``bending_moment``; by default all. Values of a whole run, such as
        ``largest_bending_moment`` (N m) and ``smallest_tension`` (N), are always kept.
    modes : int, optional
        Number of natural modes for each point: ``natural_period`` (s) with the dimension ``mode``, shapes
        with ``s_relative``. By default none.
    on_error : {"nan", "raise"}
        Of a point that cannot be completed, ``"nan"`` gives NaN, and the reason in ``failure``;
        ``"raise"`` raises a SimulationError.
    cores : int, optional
        Largest number of processes; by default the number of cores.
    progress : bool
        Show how many points are completed: a bar on a terminal or in a notebook, otherwise text.

    Returns
    -------
    xarray.Dataset
        The axes are the dimensions, in the given order. ``failure`` is empty for completed points.

    Raises
    ------
    InputError
        When an axis or a point is invalid; nothing is then simulated.
    SimulationError
        When no point can be completed; with ``on_error="raise"``, when any point cannot be completed.
    """
    _check_options(on_error, cores)
    file = scene if isinstance(scene, SceneFile) else read_scene(scene)
    study = as_study(file, axes, None if keep is None else list(keep), modes)
    for text in (*far_values(study), *idle_values(study)):
        warnings.warn(text, stacklevel=2)
    with _progress(progress, len({point.key for point in study.plan})) as done:
        failures = attempt(study, study.plan, cores or available_cores(), done)
    _check_failures(study, study.plan, failures, on_error)
    results = _stored(study, study.plan, failures)
    if doubt := _doubt(study, results):
        warnings.warn(doubt, stacklevel=2)
    return _dataset(study, results, failures).assign_attrs(title=_title(file, axes))


def _check_options(on_error: str, cores: int | None) -> None:
    if on_error not in ("nan", "raise"):
        found = f"{on_error!r} is not one of the choices"
        raise InputError("sweep", "on_error", found, "write 'nan' or 'raise'")
    check_cores("sweep", cores)


def _title(file: SceneFile, axes: Iterable[str]) -> str:
    return f"{file.tree.get('title') or 'a scene'}: sweep of {', '.join(axes)}"


def _check_failures(study: Study, points: list[Point], failures: Mapping[str, object], on_error: str) -> None:
    """Raise an error for points that cannot be completed, if it was requested or none can be."""
    if failures and (on_error == "raise" or len(failures) == len({p.key for p in points})):
        raise SimulationError(_in_words(study, points, failures))


def _stored(study: Study, points: list[Point], failures: Mapping[str, object]) -> dict[str, Result]:
    """Results of completed points by key. Raises SimulationError when some are no longer in the store."""
    stored = {p.key: store.get(p.key, study.model.keep) for p in points if p.key not in failures}
    results = {key: result for key, result in stored.items() if result}
    if len(results) < len(stored):
        raise SimulationError("sweep: results were deleted from the cache during the run; repeat the run")
    return results


def _doubt(study: Sweep, results: Mapping[str, Result]) -> str:
    """A warning of points whose estimated error is larger than the result; empty without such points."""
    from riserstudy.simulation.tolerance import doubt_of

    doubts = {key: doubt for key, result in results.items() if (doubt := doubt_of(result.facts))}
    if not doubts:
        return ""
    first = next(p for p in study.plan if p.key in doubts)
    at = f"at {study.place(first.index)}: {sentence(doubts[first.key])}"
    return f"sweep: {counted(len(doubts), 'point')} without a known result; {at}"


def _dataset(study: Sweep, results: Mapping[str, Result], failures: Mapping[str, object]) -> xr.Dataset:
    """Results of points, and the reasons why some have none."""
    points = study.plan
    empty = _without_numbers(next(iter(results.values())))
    dataset = dataset_of(study, [results.get(p.key) or empty for p in points])
    reasons = [str(failures.get(p.key, "")) for p in points]
    shape = tuple(len(steps) for steps in study.axes.values())
    about = {"long_name": "why the point could not be completed, empty where it was"}
    dataset["failure"] = (tuple(study.axes), np.array(reasons, dtype=object).reshape(shape), about)
    return dataset


def _in_words(study: Study, points: list[Point], failures: Mapping[str, object]) -> str:
    """The number of points that cannot be completed, and the reason for the first, in words."""
    point = next(p for p in points if p.key in failures)
    many = counted(len(failures), "point")
    return f"sweep: {many} cannot be completed; at {study.place(point.index)}: {failures[point.key]}"


def as_study(
    file: SceneFile, axes: Mapping[str, Values | Labelled], keep: list[str] | None, modes: int | None = None
) -> Sweep:
    """A grid over a scene as a study; axes as in `sweep`. Raises InputError when an axis is invalid."""
    if not axes:
        raise InputError("sweep", "axes", "no axis is given", "give at least one path with its values")
    made = dict(_axis(file, path, values) for path, values in axes.items())
    if len(made) < len(axes):
        allowed = "give the values of one of these axes as labels"
        raise InputError("sweep", "axes", "two axes have the same name", allowed)
    fields = {
        "scene": "scene.yaml",
        "caption": file.tree.get("title", ""),
        "axes": made,
        "keep": keep,
        "modes": modes,
    }
    model = check(StudyModel, fields, "sweep")
    return Sweep("sweep", "sweep", model, Path(), "standard", file=file)


def _axis(file: SceneFile, path: str, values: Values | Labelled) -> tuple[str, Any]:
    """Name of a dimension, and its axis in the form of study files."""
    if isinstance(values, Mapping):
        return path, {label: dict(sets) for label, sets in values.items()}
    allowed = "give a list of numbers or texts, such as [8, 10] or ['8 s', '10 s']"
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise InputError("sweep", f"axes.{path}", f"{values!r} is not a list of values", allowed)
    listed = [v.item() if isinstance(v, np.generic) else v for v in values]
    if not all(isinstance(v, int | float | str | bool | None) for v in listed):
        found = f"{listed!r} contains something other than numbers and texts"
        raise InputError("sweep", f"axes.{path}", found, allowed)
    if not listed or len(set(listed)) < len(listed):
        found = f"the list {listed} is empty or repeats a value"
        raise InputError("sweep", f"axes.{path}", found, "give different values, one or more")
    name = as_name(path)
    plain = [isinstance(v, int | float) and not isinstance(v, bool) for v in listed]
    if all(plain):
        return name, {"path": path, "unit": _unit_at(file, path), "values": listed}
    parts = [_QUANTITY.fullmatch(v) if isinstance(v, str) else None for v in listed]
    if any(plain) and any(parts):
        allowed = "give a unit to all values, or to none (they then have the unit of the scene)"
        found = f"only some of the values {listed} have a unit"
        raise InputError("sweep", f"axes.{path}", found, allowed)
    quantities = [(float(part[1]), part[2]) for part in parts if part]
    if len(quantities) < len(listed) or in_si(path, listed[0])[0] is None:
        return name, {str(value): {path: value} for value in listed}
    return name, {"path": path, "unit": quantities[0][1], "values": _in_one_unit(path, quantities)}


def _in_one_unit(path: str, quantities: list[tuple[float, str]]) -> list[float]:
    """Numbers of quantities, converted to the unit of the first."""
    unit = quantities[0][1]
    try:
        return [x if own == unit else float(f"{x * factor(own, unit):.15g}") for x, own in quantities]
    except UnitFault as fault:
        units = ", ".join(dict.fromkeys(own for _, own in quantities))
        found = f"the units {units} cannot be combined: one {fault.found}"
        raise InputError("sweep", f"axes.{path}", found, "use one unit for all values") from None


def _unit_at(file: SceneFile, path: str) -> str:
    """Unit of the scene's value at a path; "1" if it has no unit or no value."""
    value = value_at(file.tree, path)
    quantity = _QUANTITY.fullmatch(value) if isinstance(value, str) else None
    return quantity[2] if quantity else "1"


def _without_numbers(result: Result) -> Result:
    """A result of the same form in which all numbers are NaN."""
    arrays = {
        name: values if name in KEPT or values.dtype.kind != "f" else np.full_like(values, np.nan)
        for name, values in result.arrays.items()
    }
    return Result(arrays, {"warnings": [], "effects": {}})


@contextmanager
def _progress(progress: bool, count: int) -> Iterator[Callable[[int], None]]:
    """A function for the number of additional completed points, which shows progress."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

    console = Console(file=sys.stderr)
    if progress and not (console.is_terminal or console.is_jupyter):
        yield Lines(count)
        return
    columns = ("points", BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, disable=not progress) as bar:
        task = bar.add_task("points", total=count)
        yield lambda more: bar.advance(task, more)


class Lines:
    """Prints the progress of a sweep on stderr: a line at the begin, and then one every few seconds."""

    def __init__(self, count: int):
        self._count, self._done, self._stored = count, 0, -1
        self._last_notice = time.monotonic()
        self._first: tuple[float, int] | None = None  # time, and completed points, after the first run

    def __call__(self, more: int) -> None:
        """Report additional completed points; the first call has the stored points."""
        now, self._done = time.monotonic(), self._done + more
        if self._stored < 0:
            self._stored = self._done
            if self._done < self._count:
                self._notify(f"{counted(self._count, 'point')}, {self._stored} of them stored")
        elif now - self._last_notice > EVERY or self._done == self._count:
            self._last_notice = now
            self._notify(f"{self._done} of {counted(self._count, 'point')}{self._to_go(now)}")
        if self._first is None and self._done > self._stored:
            self._first = now, self._done

    def _to_go(self, now: float) -> str:
        """The time of the remaining points in words; the first run is left out, since it may compile."""
        if self._first is None or self._done == self._count:
            return ""
        began, done = self._first
        left = (now - began) * (self._count - self._done) / (self._done - done)
        return f", about {duration(left)} to go"

    def _notify(self, line: str) -> None:
        print(f"sweep: {line}", file=sys.stderr, flush=True)
