"""The smallest pull of the cylinders that work: a cylinder that has failed pulls nothing, as it should."""

from __future__ import annotations

import numpy as np

from riserstudy.records.arrays import Arrays, FloatArray
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.tensioners import Tensioners
from riserstudy.simulation.step_peaks import peaks_of
from riserstudy.simulation.until import count_until

FORCE = "tensioner_force"


def has_failures(scene: Resolved) -> bool:
    """Whether a cylinder has failed, or fails during a run."""
    rig = scene.top.tensioners
    return rig is not None and bool(rig.failed or rig.failing)


def while_working(rig: Tensioners, times: FloatArray) -> list[tuple[list[int], int]]:
    """Groups of cylinders that work, each with the number of times (s), (n,), until which they do."""
    groups = [([c for c, share in enumerate(rig.still_working) if share], len(times))]
    if rig.failing:
        groups.append((list(rig.failing.cylinders), count_until(times, rig.failing.at)))
    return [(cylinders, count) for cylinders, count in groups if cylinders and count]


def smallest_pull(scene: Resolved, arrays: Arrays, every_step: Arrays) -> dict[str, float]:
    """Smallest pull of a working cylinder with its time (s), as in a row of extremes.

    Empty if no cylinder fails. ``every_step``: time and pulls of all steps; without them, outputs count.
    """
    rig = scene.top.tensioners
    if rig is None or not has_failures(scene):
        return {}
    by_steps = FORCE in every_step
    over_time = every_step if by_steps else arrays
    if FORCE not in over_time or "time" not in over_time:
        rest = arrays[f"{FORCE}_static"][np.array(rig.working) > 0.0]
        return {"smallest": float(rest.min())}
    times, pulls, found = over_time["time"], over_time[FORCE], []
    for cylinders, count in while_working(rig, times):
        own, until = pulls[:count, cylinders], times[:count]
        if by_steps:
            peak = peaks_of(until, {FORCE: own})[FORCE]
            found.append((peak.smallest, peak.smallest_time))
        else:
            k = int(own.min(axis=1).argmin())
            found.append((float(own[k].min()), float(until[k])))
    least, time = min(found)
    return {"smallest": least, "smallest_time": time}


def of_working(scene: Resolved, times: FloatArray, pulls: FloatArray) -> FloatArray:
    """Pulls (N) over times (s), (times, cylinders); infinite where a cylinder does not work."""
    rig = scene.top.tensioners
    if rig is None:
        return pulls
    working = np.full(pulls.shape, np.inf)
    for cylinders, count in while_working(rig, times):
        working[:count, cylinders] = pulls[:count, cylinders]
    return working
