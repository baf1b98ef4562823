"""The inputs that a scene must give for the output of a limit."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from riserstudy.scene.limits import Limit
from riserstudy.scene.quantities import QUANTITIES, wall_lacks

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts

ROUNDING = 1e-9  # relative


def lacks(scene: Parts, limit: Limit) -> list[str]:
    """What a scene lacks for the output of a limit; empty where the output can be computed."""
    name = limit.output
    if limit.side == "mean" and (short := _lacks_period(scene, limit)):
        return short
    if name == "von_mises_stress":
        names = limit.sections([section.name for section in scene.riser])
        return [
            lack
            for section in (scene.riser if limit.at else scene.riser_sections)
            if section.name in names
            for lack in wall_lacks(scene, section)
        ]
    lack = QUANTITIES[name].lacks(scene)
    return [lack] if lack else []


class MeanTimes(NamedTuple):
    """Times over which a mean is taken (s); start and end are equal for a scene at rest."""

    start: float
    end: float
    periods: int = 0  # number of whole periods that fit; 0 for other motion


def last_time(scene: Parts, limit: Limit) -> float:
    """Time until which a limit applies (s); infinite if it applies to a whole run."""
    return scene.connected_until if limit.ends_with_disconnect else math.inf


def times_of_mean(scene: Parts, output: str, last: float = math.inf) -> MeanTimes:
    """Times over which the mean of an output is taken.

    A mean starts after the ramps, unless the run ends before. After the ramps of a periodic motion, it is
    taken over the last whole periods, since a part of a period would bias it. An angle of a lower flex joint
    ends at a disconnect. ``last``: last known time (s), if it is before the end of the run.
    """
    given, periods = scene.analysis.output, scene.regular_periods
    end = min(scene.analysis.duration or 0.0, last)
    start = (given.start if given else None) or 0.0
    if output == "lfj_angle":
        end = min(end, scene.lower_joint_until)
    start = scene.built_up if start < scene.built_up < end else start
    if not periods:
        return MeanTimes(start, end)
    whole = max(math.floor((end - start) / max(periods) * (1.0 + ROUNDING)), 0)
    if whole and start >= scene.built_up:
        start = max(start, end - whole * max(periods))
    return MeanTimes(start, end, whole)


def lacks_outputs(scene: Parts) -> str:
    """What a scene lacks for means over outputs: outputs that see few phases of a motion are biased."""
    output, shortest = scene.analysis.output, scene.shortest_regular_period
    if not output or not shortest or output.interval < 0.5 * shortest * (1.0 - ROUNDING):
        return ""
    return f"an analysis.output.interval below half of the shortest period, {shortest:g} s"


def _lacks_period(scene: Parts, limit: Limit) -> list[str]:
    """What a scene lacks for a mean over a periodic motion: a part of a period would give its phase."""
    periods, last = scene.regular_periods, last_time(scene, limit)
    if not periods or not scene.analysis.duration or times_of_mean(scene, limit.output, last).periods:
        return []
    whole = f"the longest period, {max(periods):g} s, after the ramps"
    if last < scene.analysis.duration:
        return [f"a later disconnect.at, with {whole}"]
    return [f"an analysis.duration with {whole}"]
