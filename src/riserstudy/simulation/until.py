"""Outputs of a run until an event that ends them, or that ends the operations of limits."""

from __future__ import annotations

import numpy as np

from riserstudy.records.arrays import Arrays, FloatArray
from riserstudy.records.seen import Seen
from riserstudy.scene.limits import UNITS
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


def until_disconnect(
    scene: Resolved, arrays: Arrays, histories: Arrays, of: Seen
) -> tuple[Arrays, Arrays, Seen]:
    """Arrays, histories and values of all steps, as arguments of `simulation.extremes`, until a disconnect.

    ``histories``: histories that are not in ``arrays``.
    """
    times, end = arrays["time"], scene.connected_until
    whole = {name: values for name, values in arrays.items() if not name.endswith(("_max", "_min"))}
    over_time = {name: values for name, values in arrays.items() if name in ("time", *UNITS)}
    held = whole | _until(over_time, times, end) | of.connected
    every = of.steps.get("time", times)
    seen = Seen(steps=_until(of.steps, every, end), rotations=_until(of.rotations, every, end))
    return held, _until(histories, times, end), seen


def _until(values: Arrays, times: FloatArray, end: float) -> Arrays:
    """Arrays over times (s), (times, ...), up to an event (s)."""
    count = count_until(times, end)
    return {name: of[:count] for name, of in values.items()}
