"""Motions given as points, such as measured records: warnings about times of a run that they do not cover."""

from __future__ import annotations

from itertools import pairwise
from statistics import median
from typing import TYPE_CHECKING, Any

from riserstudy.scene.forcing import TILTS, TRANSLATIONS, TimeSeries

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts

WIDE = 4.0  # an interval longer than this multiple of the median interval is a gap
# smallest number of points with which a motion counts as a record with a usual interval
RECORDED = 20


def uncovered(scene: Parts) -> list[str]:
    """A warning for each motion whose points begin after the run, end before it, or have a gap.

    If a motion has two points of equal value at an end, the platform is meant to rest there: no warning.
    """
    duration, platform = scene.analysis.duration, scene.platform
    if duration is None or platform is None:
        return []
    sentences = []
    for name in (*TRANSLATIONS, *TILTS):
        motion = getattr(platform, name)
        if isinstance(motion, TimeSeries):
            sentences += [f"platform.{name}: {what}" for what in _of_points(motion.points, duration)]
    return sentences


def _of_points(points: list[Any], duration: float) -> list[str]:
    times = [point.time for point in points]
    first, last = times[0], times[-1]
    if first >= duration or last <= 0.0:
        return [
            f"its points, from {first:g} s to {last:g} s, are outside of the run, from 0 s to {duration:g} "
            "s, in which the platform does not move; shift the times of the points"
        ]
    sentences = []
    if first > 0.0 and points[0].value != points[1].value:
        sentences.append(
            f"its points begin at {first:g} s, so the motion keeps its first value from 0 s until then; add "
            "earlier points, or shift the times"
        )
    if last < duration and points[-1].value != points[-2].value:
        sentences.append(
            f"its points end at {last:g} s, so the motion keeps its last value until the end of the run at "
            f"{duration:g} s; add later points, or give a shorter analysis.duration"
        )
    steps = [b - a for a, b in pairwise(times)]
    usual, widest = median(steps), max(range(len(steps)), key=steps.__getitem__)
    if len(points) >= RECORDED and steps[widest] > WIDE * usual:
        sentences.append(
            f"a spline bridges the gap between its points at {times[widest]:g} s and "
            f"{times[widest + 1]:g} s, and can exceed all of them; add points there, since most points are "
            f"{usual:.4g} s apart"
        )
    return sentences
