"""The time at which a run first reaches each limit of a scene, from which watch circles are computed."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from riserstudy.dataset.limits import sections_of
from riserstudy.dataset.place_of_crossing import place_of_crossing
from riserstudy.model.mesh import Mesh
from riserstudy.records.arrays import Arrays, FloatArray
from riserstudy.scene.limit_inputs import last_time
from riserstudy.scene.limits import ALONG, SIGNED, Limit
from riserstudy.scene.pressures import not_in_demand
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.extremes import places
from riserstudy.simulation.until import until_release
from riserstudy.simulation.working_cylinders import FORCE, of_working

NEVER, UNKNOWN = "never", "unknown"
LEAST = 3  # smallest number of outputs for a curvature


class Reached(NamedTuple):
    """Time (s) at which a limit is first reached, NEVER, or UNKNOWN where its history is missing."""

    time: float | str
    # estimated error (s) due to the interval of outputs; 0 if all time steps are known
    error: float


def first_reached(
    scene: Resolved, mesh: Mesh, arrays: Arrays, histories: Arrays, every_step: Mapping[str, FloatArray]
) -> list[Reached]:
    """Time at which each limit is first reached.

    Interpolation is linear between time steps, or between outputs if the steps are not known. The time at
    which a mean is reached is not defined: UNKNOWN. A smallest tension is reached where the mud above the
    riser exceeds its margin.

    Parameters
    ----------
    histories : histories along the riser at all nodes, (time, n + 1), in addition to those in ``arrays``.
    every_step : time (s) and outputs with one value per time, at all steps; empty if only outputs are known.
    """
    found = []
    for limit in scene.limits or []:
        values, by_steps = None, limit.output in every_step
        seen = until_release(scene, limit.output, {**arrays, **every_step} if by_steps else arrays)
        if limit.side != "mean" and "time" in seen:
            values = _demand(scene, mesh, limit, seen, {} if by_steps else histories)
        if values is None:
            found.append(Reached(UNKNOWN, 0.0))
            continue
        sign = -1.0 if limit.side == "smallest" else 1.0
        times = seen["time"]
        allowable = limit.allowable + not_in_demand(scene, limit)
        time = place_of_crossing(sign * values, sign * allowable, times)
        word = UNKNOWN if math.isnan(time) else NEVER
        if time > last_time(scene, limit):
            time = math.inf
        error = 0.0 if by_steps else _error(times, values, time)
        found.append(Reached(time if math.isfinite(time) else word, error))
    return found


def _error(times: FloatArray, values: FloatArray, time: float) -> float:
    """Estimated error of a time (s) between two outputs: deviation from the linear interpolation / slope.

    The deviation is that of a parabola with the larger curvature of both ends. The error is at most the time
    between the outputs.
    """
    k = int(np.searchsorted(times, time))
    if not 0 < k < len(times) or len(times) < LEAST:
        return 0.0
    step = float(times[k] - times[k - 1])
    slope = abs(float(values[k] - values[k - 1]))
    bends = abs(np.diff(values[max(k - 2, 0) : k + 2], 2))
    return min(step, step * 0.125 * float(bends.max()) / slope) if slope > 0.0 else step


def _demand(
    scene: Resolved, mesh: Mesh, limit: Limit, arrays: Arrays, histories: Arrays
) -> FloatArray | None:
    """The limited quantity over time, at the worst of its places; None if a place has no history."""
    name = limit.output
    history: Any = histories.get(name, arrays.get(name))
    if history is None or len(history) != len(arrays["time"]):
        return None
    values = history.reshape(len(history), -1)
    if name in ALONG:
        if values.shape[1] != len(mesh.s):
            return None
        at = dict(places(scene, mesh, name))
        sections = scene.riser if limit.at else sections_of(scene, limit)
        wanted = [place for place in limit.places([one.name for one in sections]) if place]
        if not set(wanted) <= set(at):
            return None
        values = np.concatenate([values[:, at[place]] for place in wanted], axis=1)
    if name == FORCE and limit.side == "smallest":
        values = of_working(scene, arrays["time"], values)
    if limit.side == "smallest":
        return np.asarray(values.min(axis=1))
    return np.asarray((abs(values) if name in SIGNED else values).max(axis=1))
