"""A warning about a platform that turns about a place far beside the riser's top."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.geometry import length_of

if TYPE_CHECKING:
    from riserstudy.scene.resolve import Resolved

SMALL_OFFSET = 1e-3  # offset without a warning, as a share of the riser's length
LEVERS = {"pitch": "up or down", "yaw": "aside"}  # where a turn moves a top that is beside the centre in x


def centre_above_the_well(scene: Resolved) -> list[RunWarning]:
    """A warning that the top has an offset, but the centre of rotation is above the well by default.

    An offset of the top does not move the centre, but a ``position`` of the platform does.
    """
    platform, offset = scene.platform, scene.top.offset or 0.0
    about = platform.centre_of_rotation if platform else None
    if (
        platform is None
        or about is None
        or about.x is not None
        or abs(offset) <= SMALL_OFFSET * length_of(scene)
    ):
        return []
    given = platform.response.moving if platform.response else []
    turns = [t for t in LEVERS if getattr(platform, t) or getattr(platform.position, t, None) or t in given]
    if not turns:
        return []
    turn, lever = turns[0], abs(offset) * math.sin(math.radians(1.0))
    text = (
        "platform.centre_of_rotation.x: not given, so the centre is above the well, {beside:.4g} m "
        "beside the riser's top; each degree of {turn} moves the top by {lever:.3g} m {way}. If the "
        "platform turns about a place in line with the top, give {at:g} m; otherwise, give the place"
    )
    values = {"beside": abs(offset), "turn": turn, "lever": lever, "way": LEVERS[turn], "at": offset}
    return [warning("centre_above_the_well", text, values)]
