"""Rules of prescribed motions of the platform."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from riserstudy.inputs.misfit import Misfit
from riserstudy.records.numerals import percent
from riserstudy.scene.motion_records import excess_of, records

if TYPE_CHECKING:
    from riserstudy.scene.parts import Parts

MOST = 0.5  # largest excess of a spline over all points, as a share of their range


def splines(scene: Parts) -> Iterator[Misfit]:
    """The spline through the points of a motion stays near them.

    Beside a long interval between short ones, a spline can exceed its points many times: through 0, 5, 5 and
    5 m at 0, 10, 20 and 600 s, it reaches -1000 m.
    """
    duration = scene.analysis.duration
    if duration is None:
        return
    for name, points in records(scene):
        found = excess_of(points, duration)
        if found and found.share > MOST:
            yield Misfit(
                f"platform.{name}.points",
                f"between {found.after:g} s and {found.before:g} s, the spline through the points exceeds "
                f"all of them by {percent(found.share)} of their range",
                "add points there, so that neighbouring intervals between points have similar lengths",
            )
