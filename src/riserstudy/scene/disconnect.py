"""The emergency disconnect: the lower end lets go of the stack while the scene goes on."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from riserstudy.scene import units as u
from riserstudy.scene.base import POSITIVE, Strict


class Valve(Strict):
    """What tensioner valves do to a constant ``top.tension`` from the release on.

    It falls smoothly to ``hold`` times the weight that hangs in water. ``failed``: the share of the tension
    whose valves do not move, and which stays.
    """

    hold: Annotated[float, Field(gt=0.0)]
    over: Annotated[u.Time, POSITIVE]
    failed: Annotated[float, Field(ge=0.0, lt=1.0)] | None = None


class Disconnect(Strict):
    """The wellhead lets go of the riser's lower end, with the body at it, at a time of the run.

    ``over``: the time in which the connector's force fades. Contents stay in the riser. Absent over: at once,
    which sends steep fronts along an undamped riser. Absent valve: tension or tensioners stay as they are.
    """

    at: Annotated[u.Time, POSITIVE]
    over: Annotated[u.Time, POSITIVE] | None = None
    valve: Valve | None = None
