"""Simulate the points of a study that the store lacks.

What is made goes to the store and is let go, so memory does not grow with the number of points.
"""

from __future__ import annotations

from collections.abc import Iterable

from riserstudy.errors import SimulationError
from riserstudy.solve.kernel_cache import mends_kernel_cache
from riserstudy.study import store
from riserstudy.study.grid import Point
from riserstudy.study.processes import each
from riserstudy.study.study import Study


def fill(study: Study, points: Iterable[Point], processes: int) -> int:
    """Simulate those of some points that the store lacks, and count them.

    Raises
    ------
    SimulationError
        When points cannot be completed: once per cause, with their number and the first one.
    """
    each_once = {point.key: point for point in points}
    missing = [point for key, point in each_once.items() if store.get(key, ()) is None]

    @mends_kernel_cache
    def one(point: Point) -> SimulationError | None:
        from riserstudy.simulation.refine import run

        file = study.grid.file(point.index)
        try:
            result = run(file.scene())
        except SimulationError as error:
            return error
        store.put(point.key, result, file)
        return None

    told = each(one, missing, processes)
    failures = [(point, why) for point, why in zip(missing, told, strict=True) if why]
    if failures:
        point, first = failures[0]
        place = dict(zip(study.axes, point.index, strict=True))
        raise SimulationError(
            f"{study.where}: {len(failures)} of {len(missing)} points cannot be completed; "
            f"the first, at index {place}: {first}"
        )
    return len(missing)
