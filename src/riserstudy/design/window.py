"""The window of a tension setting: what it must not be below, what it must not exceed, and the gap."""

from __future__ import annotations

import math
from typing import NamedTuple

from riserstudy.design.tension import Rig, setting


class Window(NamedTuple):
    """Floors and ceilings of a setting (N) by name."""

    floors: dict[str, float]
    ceilings: dict[str, float]

    @property
    def floor(self) -> str:
        """Name of the floor that governs."""
        return max(self.floors, key=lambda name: self.floors[name])

    @property
    def ceiling(self) -> str:
        """Name of the ceiling that governs."""
        return min(self.ceilings, key=lambda name: self.ceilings[name])

    @property
    def gap(self) -> float:
        """What is left between them (N); below zero there is no setting."""
        return self.ceilings[self.ceiling] - self.floors[self.floor]


def window(
    minimum: float,
    lift_off: float | None,
    rig: Rig,
    dynamic_limit: float,
    share: float,
    recoil: tuple[float | None, float | None] = (None, None),
) -> Window:
    """The window of a setting.

    Parameters
    ----------
    minimum : vertical tension that keeps the riser stable with tolerances on its weights (N), needed with
        the failed units out.
    lift_off : vertical tension that lifts the LMRP off with its overpull (N), needed with all units; None:
        not asked for.
    dynamic_limit, share : dynamic tension limit of all units (N), and how much of it a setting may be.
    recoil : smallest and largest setting (N) of an analysis of recoil; None: not known.
    """
    floors = {"minimum tension": setting(minimum, rig)}
    if lift_off is not None:
        floors["LMRP lift-off"] = setting(lift_off, rig._replace(failed=0))
    ceilings = {"dynamic tension limit": share * dynamic_limit}
    for side, value in zip((floors, ceilings), recoil, strict=True):
        if value is not None and math.isfinite(value):
            side["recoil"] = value
    return Window(floors, ceilings)
