"""Motions given as points, such as measured records: uncovered times, and splines that exceed the points."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from statistics import median
from typing import TYPE_CHECKING, Any, NamedTuple

from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.forcing import TILTS, TRANSLATIONS, TimeSeries

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts

WIDE = 4.0  # an interval longer than this multiple of the median interval is a gap
# smallest number of points with which a motion counts as a record with a usual interval
RECORDED = 20
# excess of a spline over all points, as a share of their range, from which on it is reported: of a sine, of
# which there are four points in a period beside its peaks, it is 0.2
NOTED = 0.25


class Excess(NamedTuple):
    """The largest excess of the spline through points over all of them, upwards or downwards."""

    size: float  # m or rad
    share: float  # of the range of the points
    after: float  # time of the last point before it (s)
    before: float  # time of the next point (s)


def records(scene: Parts) -> Iterator[tuple[str, list[Any]]]:
    """Name and points of each motion of the platform that is given as points."""
    for name in (*TRANSLATIONS, *TILTS):
        motion = getattr(scene.platform, name, None)
        if isinstance(motion, TimeSeries):
            yield name, motion.points


def excess_of(points: list[Any], duration: float) -> Excess | None:
    """The largest excess of a spline within a run of a duration (s); None if there is none."""
    import numpy as np  # loaded where they are needed: it takes long
    from scipy.interpolate import CubicSpline

    times, values = (np.array([getattr(point, of) for point in points]) for of in ("time", "value"))
    low, high = values.min(), values.max()
    if not high > low:
        return None
    spline = CubicSpline(times, values)
    turns = spline.derivative().roots(extrapolate=False)
    turns = turns[(turns >= 0.0) & (turns <= duration)]
    if not len(turns):
        return None
    beyond = np.maximum(spline(turns) - high, low - spline(turns))
    k = int(beyond.argmax())
    if not beyond[k] > 0.0:
        return None
    place = int(np.clip(np.searchsorted(times, turns[k]), 1, len(times) - 1))
    share = float(beyond[k] / (high - low))
    return Excess(float(beyond[k]), share, float(times[place - 1]), float(times[place]))


def uncovered(scene: Parts) -> list[RunWarning]:
    """A warning for each motion whose points begin after the run, end before it, or have a gap.

    If a motion has two points of equal value at an end, the platform is meant to rest there: no warning.
    """
    duration, platform = scene.analysis.duration, scene.platform
    if duration is None or platform is None:
        return []
    return [
        one for name, points in records(scene) for one in _of_points(f"platform.{name}", points, duration)
    ]


def _of_points(path: str, points: list[Any], duration: float) -> list[RunWarning]:
    times = [point.time for point in points]
    first, last = times[0], times[-1]
    begin, end = {"path": path, "first": first}, {"path": path, "last": last, "end": duration}
    if first >= duration or last <= 0.0:
        text = (
            "{path}: its points, from {first:g} s to {last:g} s, are outside of the run, from 0 s to {end:g} "
            "s, in which the platform does not move; shift the times of the points"
        )
        return [warning("motion_outside_the_run", text, begin | end)]
    found = []
    if first > 0.0 and points[0].value != points[1].value:
        text = (
            "{path}: its points begin at {first:g} s, so the motion keeps its first value from 0 s until "
            "then; add earlier points, or shift the times"
        )
        found.append(warning("motion_begins_late", text, begin))
    if last < duration and points[-1].value != points[-2].value:
        text = (
            "{path}: its points end at {last:g} s, so the motion keeps its last value until the end of the "
            "run at {end:g} s; add later points, or give a shorter analysis.duration"
        )
        found.append(warning("motion_ends_early", text, end))
    steps = [b - a for a, b in pairwise(times)]
    usual, widest = median(steps), max(range(len(steps)), key=steps.__getitem__)
    if len(points) >= RECORDED and steps[widest] > WIDE * usual:
        text = (
            "{path}: a spline bridges the gap between its points at {before:g} s and {after:g} s, and can "
            "exceed all of them; add points there, since most points are {usual:.4g} s apart"
        )
        gap = {"before": times[widest], "after": times[widest + 1], "usual": usual}
        found.append(warning("gap_in_a_motion", text, {"path": path, **gap}))
    elif (excess := excess_of(points, duration)) and excess.share > NOTED:
        text = (
            "{path}: between {after:g} s and {before:g} s, the spline through its points exceeds all of them "
            "by {share:percent} of their range; add points there"
        )
        values = {"path": path, "after": excess.after, "before": excess.before, "share": excess.share}
        found.append(warning("spline_beyond_its_points", text, values))
    return found
