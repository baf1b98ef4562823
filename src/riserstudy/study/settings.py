"""Mesh, step and method that are tuned to a study once, and the points that they do not serve.

A job tunes them and leaves a file, and the points depend on it. Keys under which the plan knows points are
those of the request, so that all is planned before anything is tuned; a tuned point is stored under its own
key. What is tuned is the same every time, so the plan's keys tell of it, too.
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
from riserstudy.folders import write_whole
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

#: what a point sets that is run by request, in place of what was tuned
BY_REQUEST = {"analysis.mesh": None, "analysis.step": None, "analysis.method": None}


@dataclass(frozen=True)
class Settings:
    """What a study was tuned to. Without a setting all points are run by request, ``because`` of that.

    ``error``: the largest over the accuracy, at points tuned on and others; ``work``: over that of requests.
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
    """Settings for a study; none where requests are cheaper, or no setting serves."""
    count, seed = study.tuned_at
    try:
        found = (
            quick_tune(study, seed, notify)
            if count == 1
            else tune(study, None, count, seed, notify)
        )
    except SimulationError as error:
        accuracy = study.base.tree["analysis"].get("accuracy") or ""
        return Settings(None, str(error), accuracy, count, 0, seed, None, None)
    worst = max(found.error, found.held_out)
    held_out = len(found.checked)
    points = len(found.points)
    return Settings(found.setting, "", found.accuracy, points, held_out, seed, worst, found.work)


def write_settings(settings: Settings, target: Path) -> None:
    """Write settings whole."""
    target.parent.mkdir(parents=True, exist_ok=True)
    write_whole(target, (json.dumps(asdict(settings), indent=1) + "\n").encode())


def read_settings(path: Path) -> Settings:
    """Settings as they were written.

    Raises
    ------
    InputError
        When the file is not there, or not whole.
    """
    try:
        return from_plain(json.loads(path.read_text("utf-8")))
    except (OSError, ValueError, TypeError, KeyError):
        raise InputError(
            path, "", "incomplete tuned settings", "delete the file; the next run tunes again"
        ) from None


def from_plain(held: dict[str, Any]) -> Settings:
    """Settings of plain data, as `dataclasses.asdict` makes it."""
    setting = held["setting"]
    if setting is not None:
        layers = tuple((end, float(length)) for end, length in setting["layers"])
        setting = Setting(**setting | {"layers": layers})
    return Settings(**held | {"setting": setting})


def with_setting(study: Study, setting: Setting) -> Study:
    """A study whose points have a mesh, a step and a method, and no accuracy; its digest stays."""
    made = copy(study)
    for name in ("grid", "plan", "kernel_groups"):
        vars(made).pop(name, None)
    vars(made)["base"] = study.base.with_values(setting.values, study.where)
    vars(made)["digest"] = study.digest
    return made


class Points(NamedTuple):
    """Points of a study by request, the same as they were tuned, and which of them are run by request."""

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
    """Simulate those of some points that the store lacks, as tuned, and by request where that does not serve.

    A tuned point does not serve that cannot be completed, or estimates an error above the request. Nor does
    one that estimates none, if the nearest that is known of does not.

    Parameters
    ----------
    both : points by request and as tuned, in pairs.
    count : is told of each point that is done; absent: nobody is.

    Raises
    ------
    SimulationError
        When a point cannot be completed by request either.
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
    """Whether a stored point estimates an error within what the study requests; None: it estimates none."""
    if not has_error_estimate(tuned, point):
        return None
    held = store.about(point.key)
    return held is None or not exceeds(study, held["facts"])


def _by_nearest(study: Study, points: list[Point], serves: dict[int, bool]) -> list[bool]:
    """Which of some points are not served: as is known of them by their place, or of the nearest on the axes.

    Along an axis of numbers the distance is a share of its length; other labels are farther than any number.
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
    """Whether a run estimates an error above what a study requests; not where it estimates none."""
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
    """Dataset of a study that was tuned, and its results.

    Each point says whether it was run by request (``by_request``), and whether its error was estimated.

    Parameters
    ----------
    tuned : the study with its setting; None where there is none.
    notify : is told in words how many points were simulated, ``count`` of each point that is done.

    Raises
    ------
    SimulationError
        When points cannot be completed.
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
        notify(f"{study.paper}/{study.name}: {len(results)} points, {again} of them by request")
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
