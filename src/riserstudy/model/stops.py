"""Warnings about contact with stops of tensioners and telescopic joint, at all time steps or at outputs."""

from __future__ import annotations

import numpy as np

from riserstudy.records.arrays import FloatArray
from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.ends import TelescopicJoint
from riserstudy.scene.tensioners import Tensioners

# shortest and longest possible joint of two barrels, as multiples of its length
MEET, PART = 0.5, 2.0


def stops_touched(
    rig: Tensioners, reach: FloatArray, time: FloatArray | None = None, all_steps: bool = False
) -> list[RunWarning]:
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
    return _contact("stroke", force, " a cylinder", time, all_steps)


def joint_stops_touched(
    joint: TelescopicJoint, length: FloatArray, time: FloatArray | None = None, all_steps: bool = False
) -> list[RunWarning]:
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
        one
        for how, over in beyond.items()
        for one in _contact(
            f"telescopic joint {how}", joint.stop.stiffness * np.maximum(over, 0.0), "", time, all_steps
        )
    ]


def beyond_its_barrels(joint: TelescopicJoint, length: FloatArray) -> list[RunWarning]:
    """Warnings when a joint without a stop is shorter or longer than two barrels can be.

    At the joint's length, the barrels overlap. Fully compressed, the joint is as long as the longer barrel,
    which is more than half of its length. Fully extended, it is as long as both barrels together, which is
    less than twice its length. ``length``: length of the joint, any shape (m).
    """
    stop, found = joint.stop, []
    shortest, longest = float(length.min()), float(length.max())
    about = "{reached:.3g} m of its length of {length:.3g} m: two barrels cannot do this. Give "
    if shortest < MEET * joint.length and not (stop and stop.collapse):
        text = f"top.telescopic_joint: is compressed to {about}stop.collapse and stiffness"
        found.append(warning("joint_too_short", text, {"reached": shortest, "length": joint.length}))
    if longest > PART * joint.length and not (stop and stop.stroke):
        text = f"top.telescopic_joint: is extended to {about}stop.stroke and stiffness"
        found.append(warning("joint_too_long", text, {"reached": longest, "length": joint.length}))
    return found


def _contact(
    stop: str, force: FloatArray, each: str, time: FloatArray | None, all_steps: bool
) -> list[RunWarning]:
    """A warning about forces (N), one column each over time; none without forces."""
    if not force.any():
        return []
    kind, values = f"{stop.replace(' ', '_')}_at_its_stop", {"force": force.max()}
    with_force = f"{{force:newtons}}{each}"
    if time is None:
        text = f"{stop}: reaches its stop in static equilibrium, with {with_force}"
        return [warning(f"{kind}_at_rest", text, values)]
    values["first"] = time[force.any(axis=1).argmax()]
    text = f"{stop}: first reaches its stop at t = {{first:.6g}} s"
    if all_steps:
        text += f", with a largest force of {with_force}"
    else:
        kind += "_in_outputs" if len(time) > 1 else "_in_an_output"
        text += f" or earlier, with a force of at least {with_force}, as seen in outputs"
        if len(time) > 1:
            text += " {apart:.3g} s apart"
            values["apart"] = time[1] - time[0]
    if time[0] > 0.0:
        kind += "_later"
        text += ", from t = {since:.6g} s on"
        values["since"] = time[0]
    return [warning(kind, text, values)]
