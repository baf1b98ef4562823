"""When each limit of a scene is first reached in a run: what watch circles are drawn from."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from riserstudy.dataset.limits import SIGNED, sections_of
from riserstudy.dataset.place_of_crossing import place_of_crossing
from riserstudy.model.mesh import Mesh
from riserstudy.scene.limits import ALONG, Limit
from riserstudy.scene.resolve import Resolved
from riserstudy.simulation.extremes import places

FloatArray = NDArray[np.float64]
Arrays = dict[str, FloatArray]
NEVER, UNKNOWN = "never", "unknown"


def first_reached(
    scene: Resolved, mesh: Mesh, arrays: Arrays, histories: Arrays
) -> list[float | str]:
    """Time (s) at which each limit is first reached, NEVER, or UNKNOWN where its history is missing.

    Straight between the outputs. A mean is reached at no time: UNKNOWN.

    Parameters
    ----------
    histories : of outputs along the riser at all nodes, (time, n + 1), beside those among the arrays.
    """
    found: list[float | str] = []
    for limit in scene.limits or []:
        values = None
        if limit.side != "mean" and "time" in arrays:
            values = _demand(scene, mesh, limit, arrays, histories)
        if values is None:
            found.append(UNKNOWN)
            continue
        sign = -1.0 if limit.side == "smallest" else 1.0
        time = place_of_crossing(sign * values, sign * limit.allowable, arrays["time"])
        found.append(UNKNOWN if math.isnan(time) else time if math.isfinite(time) else NEVER)
    return found


def _demand(
    scene: Resolved, mesh: Mesh, limit: Limit, arrays: Arrays, histories: Arrays
) -> FloatArray | None:
    """What a limit looks at over time, the worst of its places; None without a history at all of these."""
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
    if limit.side == "smallest":
        return np.asarray(values.min(axis=1))
    return np.asarray((abs(values) if name in SIGNED else values).max(axis=1))
