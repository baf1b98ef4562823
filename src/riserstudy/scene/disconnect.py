"""The emergency disconnect: the lower end lets go of the stack while the scene goes on."""

from __future__ import annotations

import math
from typing import Annotated

from pydantic import Field

from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE

SAME = 1e-9  # share of a period by which a phase may be missed


class Valve(Strict):
    """What tensioner valves do to a constant ``top.tension`` from the release on.

    It falls smoothly to ``hold`` times the weight that hangs in water. ``failed``: the share of the tension
    whose valves do not move, and which stays.
    """

    hold: Annotated[float, Field(gt=0.0)]
    over: Annotated[u.Time, POSITIVE]
    failed: Annotated[float, Field(ge=0.0, lt=1.0)] | None = None


class Isolation(Strict):
    """Bottles that are shut off from each cylinder, a time after the release, with the gas in them."""

    after: Annotated[u.Time, NOT_NEGATIVE]
    volume: Annotated[u.Volume, POSITIVE]


class RecoilValve(Strict):
    """A valve in the oil between each cylinder and its gas, which throttles from the release on.

    ``opening``: area of the open valve; ``discharge``: its coefficient. It closes to the share ``residual``
    of the opening, smoothly within ``over``, ``delay`` after the release. ``failed`` cylinders, counted from
    0, have valves that stay open. Absent delay: none; isolation: all gas stays in use.
    """

    oil_density: Annotated[u.Density, POSITIVE]
    opening: Annotated[u.Area, POSITIVE]
    discharge: Annotated[float, Field(gt=0.0, le=1.0)]
    residual: Annotated[float, Field(gt=0.0, le=1.0)]
    over: Annotated[u.Time, POSITIVE]
    delay: Annotated[u.Time, NOT_NEGATIVE] | None = None
    failed: list[Annotated[int, Field(ge=0)]] | None = None
    isolation: Isolation | None = None


class Drain(Strict):
    """Contents that run out from the release on, as one column between the air above and the sea below.

    ``friction``: Darcy's factor of the wall. ``losses``: heads of velocity lost at the ends. Absent: none.
    """

    friction: Annotated[float, NOT_NEGATIVE]
    losses: Annotated[float, NOT_NEGATIVE] | None = None


class Stack(Strict):
    """What the lower end may come down on again: a one-sided spring, wherever the riser is by then."""

    stiffness: Annotated[u.Stiffness, POSITIVE]


class Disconnect(Strict):
    """The wellhead lets go of the riser's lower end, with the body at it, at a time of the run.

    ``phase``: not at that time but the first time from then on when the platform's heave, one harmonic, is at
    this phase of its sine: 0 on its way up through the middle, 90 deg at the top.
    ``over``: the time in which the connector's force fades. Absent: at once, which sends steep fronts along
    an undamped riser. Absent valve and recoil_valve: tension or tensioners stay as they are; drain: contents
    stay in the riser; stack: the riser may pass its place, with a warning.
    """

    at: Annotated[u.Time, POSITIVE]
    phase: u.Angle | None = None
    over: Annotated[u.Time, POSITIVE] | None = None
    valve: Valve | None = None
    recoil_valve: RecoilValve | None = None
    drain: Drain | None = None
    stack: Stack | None = None

    def timed(self, period: float, phase: float) -> Disconnect:
        """The release at the time of its phase, under a heave of a period (s) and a first phase (rad)."""
        turn = ((self.phase or 0.0) - phase) / (2.0 * math.pi)
        turns = math.ceil(self.at / period - turn - SAME)
        return self.model_copy(update={"at": (turns + turn) * period})
