"""The emergency disconnect: the wellhead releases the lower end during the run."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated

from pydantic import Field

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE

SAME = 1e-9  # share of a period within which a phase counts as reached


def too_late(times: Mapping[str, float], duration: float, *also: str) -> Iterator[Misfit]:
    """Faults of events at some times (s), by path, that are not before the end of a run (s)."""
    for path, at in times.items():
        if not at < duration:
            found = f"happens at {at:g} s, which is not before the end of the run at {duration:g} s"
            remedy = "give an earlier time or a longer analysis.duration"
            yield Misfit(path, found, remedy, ("analysis.duration", *also))


class Valve(Strict):
    """Tensioner valves that change a constant ``top.tension`` after the release of the lower end.

    After a disconnect, the top tension decreases smoothly to ``hold`` times the suspended submerged weight.
    The key ``failed`` is the fraction of the top tension that remains constant, because the valves of some
    tensioners fail to move.
    """

    hold: Annotated[float, Field(gt=0.0)]
    over: Annotated[u.Time, POSITIVE]
    failed: Annotated[float, Field(ge=0.0, lt=1.0)] | None = None


class Isolation(Strict):
    """Gas bottles that are shut off from each cylinder, with their gas, at a time after the disconnect."""

    after: Annotated[u.Time, NOT_NEGATIVE]
    volume: Annotated[u.Volume, POSITIVE]


class RecoilValve(Strict):
    """A recoil valve in the oil between each cylinder and its gas, which closes after a disconnect.

    The key ``opening`` is the area of the open recoil valve. The open recoil valve throttles the oil even
    before the disconnect. The key ``discharge`` is the discharge coefficient of the recoil valve. At the time
    ``delay`` after the disconnect, by default 0 s, the recoil valve starts to close. Within the time
    ``over``, the recoil valve closes smoothly to the fraction ``residual`` of its opening. The key ``failed``
    lists the cylinders (numbered from 0) whose recoil valves stay open. Without ``isolation``, no gas bottles
    are shut off.
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
    """Contents that drain after a disconnect, as one column between the air above and the sea below.

    The key ``friction`` is the Darcy friction factor of the riser wall for draining contents. The key
    ``losses``, by default zero, is the pressure loss at the ends of the draining column, divided by the
    velocity head at the lower end.
    """

    friction: Annotated[float, NOT_NEGATIVE]
    losses: Annotated[float, NOT_NEGATIVE] | None = None


class Stack(Strict):
    """BOP stack that the riser can hit after a disconnect: a spring below the lower end that only pushes."""

    stiffness: Annotated[u.Stiffness, POSITIVE]


class Disconnect(Strict):
    """Release of the riser's lower end, with the body at this end, from the wellhead during the run.

    The key ``at`` is the time of the disconnect. With the key ``phase``, the disconnect is delayed until the
    platform's heave has the given phase. The phase of the heave is 0 when the heave rises through its mean,
    and 90 deg at its maximum. In a scene with the key ``phase`` of the disconnect, the heave must be a single
    harmonic. The key ``over`` is the time over which the force of the connector decreases to zero. By
    default, the disconnect is sudden. A sudden disconnect of an undamped riser causes tension waves with
    steep fronts along the riser. A constant top tension remains unchanged after the disconnect, unless
    ``valve`` is given. The tensioners act as before the disconnect, unless ``recoil_valve`` is given. By
    default, the contents stay in the riser after a disconnect. With the key ``drain``, the contents flow out
    of the riser after a disconnect. Without ``stack``, the lower marine riser package (LMRP) can move through
    the blow-out preventer (BOP) stack without contact, and a warning appears.
    """

    at: Annotated[u.Time, POSITIVE]
    phase: u.Angle | None = None
    over: Annotated[u.Time, POSITIVE] | None = None
    valve: Valve | None = None
    recoil_valve: RecoilValve | None = None
    drain: Drain | None = None
    stack: Stack | None = None

    @property
    def times(self) -> dict[str, float]:
        """Times from which on the parts of the disconnect act (s), by their paths in the scene."""
        valve, times = self.recoil_valve, {"disconnect.at": self.at}
        if valve and valve.delay is not None:
            times["disconnect.recoil_valve.delay"] = self.at + valve.delay
        if valve and valve.isolation:
            times["disconnect.recoil_valve.isolation.after"] = self.at + valve.isolation.after
        return times

    def timed(self, period: float, phase: float) -> Disconnect:
        """The release at the time of its phase, in heave of a period (s) with an initial phase (rad)."""
        turn = ((self.phase or 0.0) - phase) / (2.0 * math.pi)
        turns = math.ceil(self.at / period - turn - SAME)
        return self.replaced(at=(turns + turn) * period)
