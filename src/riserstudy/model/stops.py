"""Warnings about contact with stops of tensioners and telescopic joint, at all time steps or at outputs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from riserstudy.records.numerals import newtons
from riserstudy.scene.ends import TelescopicJoint
from riserstudy.scene.tensioners import Tensioners

FloatArray = NDArray[np.float64]
# shortest and longest possible joint of two barrels, as multiples of its length
MEET, PART = 0.5, 2.0


def stops_touched(
    rig: Tensioners, reach: FloatArray, time: FloatArray | None = None, all_steps: bool = False
) -> list[str]:
    """A warning when cylinders reach their end stops.

    Parameters
    ----------
    reach : extension of the cylinders, (c,) at rest or (k, c) over time (m).
    time : (k,) times of the outputs or time steps (s); contact between two of them is not detected.
    all_steps : whether these are all time steps of the run.
    """
    if rig.stroke is None:
        return []
    beyond = np.maximum(reach - rig.stroke.longest, rig.stroke.shortest - reach)
    working = np.array(rig.working)
    if rig.failing and time is not None:
        working = np.where((time > rig.failing.at)[:, None], rig.still_working, working)
    force = rig.stroke.stop_stiffness * np.maximum(beyond, 0.0) * working
    return _forces_in_words("stroke", force, " a cylinder", time, all_steps)


def joint_stops_touched(
    joint: TelescopicJoint, length: FloatArray, time: FloatArray | None = None, all_steps: bool = False
) -> list[str]:
    """Warnings when a telescopic joint reaches a stop, one for each stop.

    Parameters
    ----------
    length : length of the joint, (1,) at rest or (k, 1) over time (m).
    time : (k,) times of the outputs or time steps (s); contact between two of them is not detected.
    all_steps : whether these are all time steps of the run.
    """
    if joint.stop is None:
        return []
    shortest, longest = joint.reach
    beyond = {"stroked out": length - longest, "collapsed": shortest - length}
    return [
        sentence
        for how, over in beyond.items()
        for sentence in _forces_in_words(
            f"telescopic joint {how}", joint.stop.stiffness * np.maximum(over, 0.0), "", time, all_steps
        )
    ]


def beyond_its_barrels(joint: TelescopicJoint, length: FloatArray) -> list[str]:
    """Warnings when a joint without a stop is shorter or longer than two barrels can be.

    At the joint's length, the barrels overlap. Fully compressed, the joint is as long as the longer barrel,
    which is more than half of its length. Fully extended, it is as long as both barrels together, which is
    less than twice its length. ``length``: length of the joint, any shape (m).
    """
    stop, sentences = joint.stop, []
    shortest, longest = float(length.min()), float(length.max())
    about = f"of its length of {joint.length:.3g} m: two barrels cannot do this. Give "
    if shortest < MEET * joint.length and not (stop and stop.collapse):
        sentences.append(
            f"top.telescopic_joint: is compressed to {shortest:.3g} m {about}stop.collapse and stiffness"
        )
    if longest > PART * joint.length and not (stop and stop.stroke):
        sentences.append(
            f"top.telescopic_joint: is extended to {longest:.3g} m {about}stop.stroke and stiffness"
        )
    return sentences


def _forces_in_words(
    stop: str, force: FloatArray, each: str, time: FloatArray | None, all_steps: bool
) -> list[str]:
    """A sentence about forces (N), one column each over time; "" without forces."""
    if not force.any():
        return []
    if time is None:
        return [f"{stop}: reaches its stop in static equilibrium, with {newtons(force.max())}{each}"]
    first = float(time[force.any(axis=1).argmax()])
    after = f", from t = {time[0]:.6g} s on" if time[0] > 0.0 else ""
    touch = f"{stop}: first reaches its stop at t = {first:.6g} s"
    if all_steps:
        return [f"{touch}, with a largest force of {newtons(force.max())}{each}{after}"]
    apart = f" {time[1] - time[0]:.3g} s apart" if len(time) > 1 else ""
    return [
        f"{touch} or earlier, with a force of at least {newtons(force.max())}{each}, as seen in "
        f"outputs{apart}{after}"
    ]
