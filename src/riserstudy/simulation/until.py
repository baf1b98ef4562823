"""The time until which an output counts, if an event of a run ends it."""

from __future__ import annotations

import numpy as np

from riserstudy.records.arrays import Arrays, FloatArray
from riserstudy.scene.resolve import Resolved

LOWER_ANGLE = "lfj_angle"


def count_until(times: FloatArray, end: float) -> int:
    """Number of times (s), (n,), up to an event; of the two steps at its time, the second is after it."""
    return min(int(np.searchsorted(times, end, "left")) + 1, int(np.searchsorted(times, end, "right")))


def until_release(scene: Resolved, name: str, values: Arrays) -> Arrays:
    """Values over time, among them those of an output; the angle of a lower flex joint ends with its release.

    After it the riser's end is free, and its direction is the angle of no joint.
    """
    if name != LOWER_ANGLE or name not in values or "time" not in values:
        return values
    count = count_until(values["time"], scene.lower_joint_until)
    if count == len(values["time"]):
        return values
    return {**values, "time": values["time"][:count], name: values[name][:count]}
