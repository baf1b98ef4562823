"""The inputs that a scene must give for the output of a limit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from riserstudy.scene.limits import Limit
from riserstudy.scene.outputs import QUANTITIES, wall_lacks

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts

ROUNDING = 1e-9  # relative


def lacks(scene: Parts, limit: Limit) -> list[str]:
    """What a scene lacks for the output of a limit; empty where the output can be computed."""
    name = limit.output
    if limit.side == "mean" and (few := _lacks_times(scene, limit)):
        return few
    if name == "von_mises_stress":
        names = limit.sections([section.name for section in scene.riser])
        return [
            lack
            for section in (scene.riser if limit.at else scene.riser_sections)
            if section.name in names
            for lack in wall_lacks(scene, section)
        ]
    quantity = QUANTITIES[name]
    return [] if quantity.is_in(scene) else [quantity.needs]


def times_of_mean(scene: Parts, limit: Limit) -> tuple[float, float]:
    """Start and end (s) of the times over which the mean of a limit is taken; equal for a scene at rest.

    A mean starts after the ramps, unless the run ends before; an angle of a lower flex joint ends at a
    disconnect.
    """
    output, end = scene.analysis.output, scene.analysis.duration or 0.0
    start = (output.start if output else None) or 0.0
    if limit.output == "lfj_angle":
        end = min(end, scene.lower_joint_until)
    return (scene.built_up if start < scene.built_up < end else start), end


def _lacks_times(scene: Parts, limit: Limit) -> list[str]:
    """What a scene lacks for a mean over a periodic motion: that of few outputs depends on their phase."""
    periods = scene.regular_periods
    start, end = times_of_mean(scene, limit)
    if not periods or not scene.analysis.duration:
        return []
    output, shortest, longest = scene.analysis.output, min(periods), max(periods)
    lacking = []
    if output and output.interval >= 0.5 * shortest * (1.0 - ROUNDING):
        lacking.append(f"an analysis.output.interval below half of the shortest period, {shortest:g} s")
    if end - start < longest * (1.0 - ROUNDING):
        lacking.append(f"an analysis.duration with the longest period, {longest:g} s, after the ramps")
    return lacking
