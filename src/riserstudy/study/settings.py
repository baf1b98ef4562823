"""Mesh, time step and method that are tuned once for a study, and the points for which they do not suffice.

A job tunes them and writes a file, on which the points depend. In the plan, points have the keys of runs with
the tolerance, so everything is planned before tuning. A tuned point is stored under another key. Tuning is
deterministic, so the plan's keys also identify the tuned points.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from copy import copy
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from riserstudy.dataset.result import Result
from riserstudy.dataset.variables import attributes
from riserstudy.errors import InputError, SimulationError
from riserstudy.files.whole import write_whole
from riserstudy.records.words import counted
from riserstudy.simulation.tolerance import allowed_of
from riserstudy.study import store
from riserstudy.study.axes import Numbers
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.grid import Point
from riserstudy.study.quick_tune import quick_tune
from riserstudy.study.setting import Setting
from riserstudy.study.simulate_points import Count, attempt, fill, has_error_estimate
from riserstudy.study.study import Study
from riserstudy.study.tune import Notify, tune

if TYPE_CHECKING:
    import xarray as xr

#: values of a point that is run with the tolerance, in place of the tuned settings
BY_REQUEST = {"analysis.mesh": None, "analysis.step": None, "analysis.method": None}


@dataclass(frozen=True)
class Settings:
    """Tuned settings of a study. Without a setting, all points use the tolerance, for the reason ``because``.

    ``error``: largest ratio of error to tolerance, at points for tuning and for the check. ``work``: work
    relative to runs with the tolerance.
    """

    setting: Setting | None
    because: str
    accuracy: str
    points: int
    held_out: int
    seed: int
    error: float | None
    work: float | None


def tuned_for(study: Study, notify: Notify) -> Settings:
    """Tuned settings for a study; no setting if runs with the tolerance are cheaper, or none suffices."""
    count, seed = study.tuned_at
    try:
        found = quick_tune(study, seed, notify) if count == 1 else tune(study, None, count, seed, notify)
    except SimulationError as error:
        accuracy = study.base.tree["analysis"].get("accuracy") or ""
        return Settings(None, str(error), accuracy, count, 0, seed, None, None)
    worst = max(found.error, found.held_out)
    held_out = len(found.checked)
    points = len(found.points)
    return Settings(found.setting, "", found.accuracy, points, held_out, seed, worst, found.work)


def write_settings(settings: Settings, target: Path) -> None:
    """Write settings completely or not at all."""
    target.parent.mkdir(parents=True, exist_ok=True)
    write_whole(target, (json.dumps(asdict(settings), indent=1) + "\n").encode())


def read_settings(path: Path) -> Settings:
    """Settings from their file. Raises InputError when the file is missing or damaged."""
    try:
        return from_plain(json.loads(path.read_text("utf-8")))
    except (OSError, ValueError, TypeError, KeyError):
        raise InputError(
            path, "", "the tuned settings in this file are incomplete", "delete it; the next run tunes again"
        ) from None


def from_plain(held: dict[str, Any]) -> Settings:
    """Settings from plain data of `dataclasses.asdict`."""
    setting = held["setting"]
    if setting is not None:
        layers = tuple((end, float(length)) for end, length in setting["layers"])
        setting = Setting(**setting | {"layers": layers})
    return Settings(**held | {"setting": setting})


def with_setting(study: Study, setting: Setting) -> Study:
    """A study whose points have a mesh, a step and a method, and no tolerance; its digest does not change."""
    made = copy(study)
    for name in ("grid", "plan", "end_keys", "kernel_groups"):
        vars(made).pop(name, None)
    vars(made)["base"] = study.base.with_values(setting.values, study.where)
    vars(made)["digest"] = study.digest
    return made


class Points(NamedTuple):
    """Points of a study with the tolerance, the same points tuned, and which of them use the tolerance."""

    requested: list[Point]
    tuned: list[Point]
    by_request: list[bool]


def fill_tuned(
    study: Study,
    tuned: Study,
    both: Iterable[tuple[Point, Point]],
    processes: int,
    count: Count | None = None,
) -> Points:
    """Simulate points that the store lacks, with the tuned setting, or with the tolerance where it fails.

    The tuned setting does not suffice for a point that cannot be completed, or whose estimated error exceeds
    the tolerance or could not be found. For a point without an estimate, the nearest point with an estimate
    decides. Raises SimulationError when a point cannot be completed with the tolerance either.

    Parameters
    ----------
    both : points with the tolerance and with the tuned setting, in pairs.
    count : function that is called for each completed point; absent: none.
    """
    pairs = list(both)
    total = len({one.key for _, one in pairs})
    done: list[int] = []

    def notify(more: int) -> None:
        done.append(more)
        if count:
            count(sum(done), total)

    points = [one for _, one in pairs]
    failures = attempt(tuned, points, processes, notify)
    serving = [False if one.key in failures else _serves(study, tuned, one) for one in points]
    known = {k: serves for k, serves in enumerate(serving) if serves is not None}
    by_request = _by_nearest(tuned, points, known)
    if again := [requested for (requested, _), by in zip(pairs, by_request, strict=True) if by]:
        fill(study, again, processes)
    return Points([requested for requested, _ in pairs], points, by_request)


def _serves(study: Study, tuned: Study, point: Point) -> bool | None:
    """Whether a stored point's estimated error is within the study's tolerance; None without estimate.

    A point whose error could not be estimated, because a coarser run failed, is not known to be within it.
    """
    if not has_error_estimate(tuned, point):
        return None
    held = store.about(point.key)
    return held is None or (held["facts"].get("error_estimate") != {} and not exceeds(study, held["facts"]))


def _by_nearest(study: Study, points: list[Point], serves: dict[int, bool]) -> list[bool]:
    """For each point, whether the setting does not suffice: as known for it, or for the nearest known point.

    Along an axis of numbers, the distance is a share of its length; a different label is farther than any
    number.
    """
    from scipy.spatial import KDTree

    if all(serves.values()):
        return [False] * len(points)
    numbers = [isinstance(study.model.axes[name], Numbers) for name in study.axes]
    lengths = np.array([max(1, len(values) - 1) for values in study.axes.values()], float)
    weights = np.where(numbers, 1.0 / lengths, len(lengths))
    places = np.array([point.index for point in points]) * weights
    known = np.array([*serves])
    nearest = known[KDTree(places[known]).query(places)[1]]
    return [not serves[int(k)] for k in nearest]


def exceeds(study: Study, facts: dict[str, Any]) -> bool:
    """Whether the estimated error of a run exceeds a study's tolerance; False without an estimate."""
    target = allowed_of(study.base.resolved())
    error = facts.get("error_estimate", {})
    return any(error.get(name, 0.0) > limit for name, limit in target.items())


def dataset_tuned(
    study: Study,
    settings: Settings,
    tuned: Study | None,
    processes: int,
    notify: Callable[[str], None],
    count: Count | None = None,
) -> tuple[xr.Dataset, list[Result]]:
    """Dataset of a tuned study, and its results.

    For each point, it has whether the point was run with the tolerance (``by_request``), and whether its
    error was estimated. Raises SimulationError when points cannot be completed.

    Parameters
    ----------
    tuned : the study with its setting; None without a setting.
    notify : function that receives a sentence with the number of simulated points; ``count`` is called for
        each completed point.
    """
    if tuned is None:
        results, _ = results_of(study, processes, notify, count)
        by_request = [True] * len(results)
        dataset = dataset_of(study, results)
    else:
        pairs = zip(study.plan, tuned.plan, strict=True)
        points = fill_tuned(study, tuned, pairs, processes, count)
        by_request = points.by_request
        results = _taken(study, tuned, points, processes)
        again = sum(by_request)
        notify(
            f"{study.paper}/{study.name}: {counted(len(results), 'point')}, "
            f"{again} of them with the tolerance"
        )
        dataset = dataset_of(tuned, results)
        keys = [a.key if by else b.key for a, b, by in zip(*points, strict=True)]
        dataset["point_key"].values = np.array(keys, object).reshape(dataset["point_key"].shape)
    at = dataset["point_key"]
    flags = np.array(by_request, np.int8).reshape(at.shape)
    dataset["by_request"] = (at.dims, flags, attributes("by_request"))
    accuracy = study.base.tree["analysis"].get("accuracy")
    dataset.attrs["request"] = json.dumps(BY_REQUEST | {"analysis.accuracy": accuracy})
    dataset.attrs["settings"] = json.dumps(asdict(settings))
    return dataset, results


def _taken(study: Study, tuned: Study, points: Points, processes: int) -> list[Result]:
    """Results of points, in order."""
    results: dict[int, Result] = {}
    for of, own, requested in ((tuned, points.tuned, False), (study, points.requested, True)):
        places = [k for k, by in enumerate(points.by_request) if by is requested]
        found, _ = results_of(of, processes, lambda _: None, points=[own[k] for k in places])
        results |= dict(zip(places, found, strict=True))
    return [results[k] for k in range(len(points.requested))]
