"""Simulate the points of a study that the store lacks.

What is made goes to the store and is let go, so memory does not grow with the number of points.
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

FEW = 16  # points of a study, up to which the error of each is estimated, but in a preview
ONE_IN = 8  # points of others, by their keys: mostly the same whatever the study


def has_error_estimate(study: Study, point: Point) -> bool:
    """Whether the error of a point is estimated where its mesh and step are prescribed.

    To estimate it takes as long again as the run. In a study whose points have one mesh and one step it is
    much the same from point to point, so that one in so many tells it. The first and the last point of the
    grid always do: keys are as good as drawn, and might leave a study of some twenty points with none. In a
    preview, which is made to be waited for, this goes for small studies too.
    """
    grid = study.grid
    if not study.estimates:
        return False
    all_of_them = len(grid) <= FEW and study.tier != "preview"
    return all_of_them or point.index in grid.ends or int(point.key[:4], 16) % ONE_IN == 0


def lacks(study: Study, point: Point, stored: Result | None) -> bool:
    """Whether a point is missing, does not tell an error that it should, or lacks its modes."""
    return _lacks_run(study, point, stored) or lacks_modes(study, point)


def _lacks_run(study: Study, point: Point, stored: Result | None) -> bool:
    return stored is None or (
        has_error_estimate(study, point) and "error_estimate" not in stored.facts
    )


#: is told how many points are done, and of how many
Count = Callable[[int, int], None]


def fill(study: Study, points: Iterable[Point], processes: int, count: Count | None = None) -> int:
    """Simulate those of some points that the store lacks, and count them.

    Parameters
    ----------
    count : is told of each point that is done; absent: nobody is.

    Raises
    ------
    SimulationError
        When points cannot be completed: once per cause, with their number and the first one.
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
        place = dict(zip(study.axes, point.index, strict=True))
        raise SimulationError(
            f"{study.where}: {len(failures)} of {made} points cannot be completed; "
            f"the first, at index {place}: {failures[point.key]}"
        )
    return made


def attempt(
    study: Study, points: Iterable[Point], processes: int, notify: Callable[[int], None]
) -> dict[str, SimulationError]:
    """Simulate what the store lacks of some points, and say why points cannot be completed, by their keys.

    Parameters
    ----------
    notify : is told how many more of the points, each counted once, are done: first how many are stored.
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
        if len(done) >= store.A_PACK:  # so that never many points have files of their own
            store.pack(done)
            done.clear()
    store.pack(key for point in each_once.values() for key in _keys(study, point))
    return failures


def _keys(study: Study, point: Point) -> list[str]:
    """What a point is stored under, and its modes."""
    count = study.model.modes
    return [point.key] if count is None else [point.key, key_of_modes(point.key, count)]


def _simulate(study: Study, point: Point) -> SimulationError | None:
    """Simulate a point and store it, or say why it cannot be completed."""
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
