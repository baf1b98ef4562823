"""Simulate the points of a study that the store lacks.

Results are written to the store and removed from memory, which therefore does not grow with the number of
points.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial

from riserstudy.dataset.result import Result
from riserstudy.errors import SimulationError
from riserstudy.study import store
from riserstudy.study.grid import Point
from riserstudy.study.modes import key_of_modes, lacks_modes, make_modes
from riserstudy.study.processes import each
from riserstudy.study.study import Study

FEW = 16  # number of points up to which the error of every point is estimated, except in a preview
# in larger studies, one in this number of points has an error estimate, selected by key
ONE_IN = 8


def has_error_estimate(study: Study, point: Point) -> bool:
    """Whether the error of a point with a prescribed mesh and step is estimated.

    An estimate takes as long as the run itself. In a study whose points have the same mesh and step, errors
    are similar, so only one in `ONE_IN` points has an estimate. The first and the last point of the grid
    always have one, because the selection by keys is random, and might select none of some twenty points. In
    a preview, which should be fast, the same applies to small studies, and the first point has none. Points
    with the same key, which differ only in their limits, are one run, and all or none have an estimate.
    """
    if not study.estimates:
        return False
    all_of_them = len(study.grid) <= FEW and study.tier != "preview"
    return all_of_them or int(point.key[:4], 16) % ONE_IN == 0 or point.key in study.end_keys


def lacks(study: Study, point: Point, stored: Result | None) -> bool:
    """Whether a point is missing, lacks a required error estimate, or lacks its modes."""
    return _lacks_run(study, point, stored) or lacks_modes(study, point)


def _lacks_run(study: Study, point: Point, stored: Result | None) -> bool:
    return stored is None or (has_error_estimate(study, point) and "error_estimate" not in stored.facts)


#: function that receives the number of completed points, and the total number
Count = Callable[[int, int], None]


def fill(study: Study, points: Iterable[Point], processes: int, count: Count | None = None) -> int:
    """Simulate the points that the store lacks; returns their number.

    ``count``: function that is called for each completed point; absent: none. Raises SimulationError when
    points cannot be completed; for each cause, the message has the number of points and the first one.
    """
    every = list(points)
    total = len({point.key for point in every})
    done: list[int] = []

    def notify(more: int) -> None:
        done.append(more)
        if count:
            count(sum(done), total)

    failures = attempt(study, every, processes, notify)
    made = total - done[0]
    if failures:
        point = next(point for point in every if point.key in failures)
        raise SimulationError(
            f"{study.where}: {len(failures)} of {made} points cannot be completed; "
            f"the first, at {study.place(point.index)}: {failures[point.key]}"
        )
    return made


def attempt(
    study: Study, points: Iterable[Point], processes: int, notify: Callable[[int], None]
) -> dict[str, SimulationError]:
    """Simulate the points that the store lacks; returns the reasons why points cannot be completed, by key.

    ``notify``: function that receives the number of additional completed points; the first call has the
    stored ones.
    """
    each_once = {point.key: point for point in points}
    stored = partial(store.get, keep=study.model.keep)
    missing = [p for key, p in each_once.items() if lacks(study, p, stored(key))]
    notify(len(each_once) - len(missing))
    failures = {}
    outcomes = each(partial(_simulate, study), missing, processes)
    done: list[str] = []
    for point, why in zip(missing, outcomes, strict=True):
        notify(1)
        if why:
            failures[point.key] = why
        done += _keys(study, point)
        if len(done) >= store.A_PACK:  # to limit the number of points in separate files
            store.pack(done)
            done.clear()
    store.pack(key for point in each_once.values() for key in _keys(study, point))
    return failures


def _keys(study: Study, point: Point) -> list[str]:
    """Keys of a point and of its modes in the store."""
    count = study.model.modes
    return [point.key] if count is None else [point.key, key_of_modes(point.key, count)]


def _simulate(study: Study, point: Point) -> SimulationError | None:
    """Simulate a point and store it; returns the error if it cannot be completed."""
    from riserstudy.simulation.refine import run

    file, keep = study.grid.file(point.index), study.model.keep
    try:
        if study.model.modes is None or _lacks_run(study, point, store.get(point.key, keep)):
            result = run(file.resolved(), estimated=has_error_estimate(study, point))
            store.put(point.key, result, file, keep)
        if lacks_modes(study, point):
            make_modes(study, point, file)
    except SimulationError as error:
        return error
    return None
