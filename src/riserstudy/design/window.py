"""The window of a tension setting: its lower and upper limits, and the gap between them."""

from __future__ import annotations

import math
from typing import NamedTuple

from riserstudy.design import tension
from riserstudy.design.tension import Rig, Tolerances, setting
from riserstudy.scene.resolve import Resolved

WEIGHED = Tolerances(1.0, 1.0)


class Window(NamedTuple):
    """Lower limits (floors) and upper limits (ceilings) of a setting (N) by name."""

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
        """Ceiling minus floor (N); below zero, no setting is possible."""
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
    minimum : vertical tension for stability of the riser with tolerances on its weights (N), required without
        the failed units.
    lift_off : vertical tension that lifts the LMRP off with its overpull (N), required with all units; None:
        not requested.
    dynamic_limit, share : dynamic tension limit of all units (N), and the allowed share of it.
    recoil : smallest and largest setting (N) from an analysis of recoil; None: not known; NaN: no setting is
        allowed.
    """
    floors = {"minimum tension": setting(minimum, rig)}
    if lift_off is not None:
        floors["LMRP lift-off"] = setting(lift_off, rig._replace(failed=0))
    ceilings = {"dynamic tension limit": share * dynamic_limit}
    for side, value in zip((floors, ceilings), recoil, strict=True):
        if value is not None:
            side["recoil"] = _or_none(value, side is floors)
    return Window(floors, ceilings)


def _or_none(value: float, is_floor: bool) -> float:
    """A limit by recoil; without an allowed setting (NaN), one that no setting meets."""
    if not math.isnan(value):
        return value
    return math.inf if is_floor else -math.inf


class Ceiling(NamedTuple):
    """The upper end of a setting."""

    dynamic_limit: float  # dynamic tension limit of all units (N)
    share: float  # share of the limit that a setting may have


def window_of(
    scene: Resolved, tolerances: Tolerances, rig: Rig, overpull: float | None, ceiling: Ceiling
) -> Window:
    """The window of a scene's setting, by the formula.

    ``overpull``: required effective tension between LMRP and stack (N); None: the LMRP is not lifted off.
    Raises ValueError when the scene does not give it: what it lacks.
    """
    needed = tension.governing(scene, tolerances).tension
    lifted = None if overpull is None else lift_off(scene, overpull)
    return window(needed, lifted, rig, *ceiling)


def lift_off(scene: Resolved, overpull: float, weighed: float | None = None) -> float:
    """Vertical tension (N) that lifts the LMRP off with an overpull (N).

    ``weighed``: vertical tension (N) at which the tension at the riser's lower end is zero, with the given
    weights; absent: by the formula. Raises ValueError when the scene does not give it: what it lacks.
    """
    if missing := lift_off_lacks(scene):
        raise ValueError("not evaluated: " + ", ".join(missing))
    body, water, gravity = scene.bottom.body, scene.water, scene.gravity
    if body is None or water is None:
        raise TypeError("no LMRP")  # excluded by the caller
    if weighed is None:
        weighed = float(tension.needed(scene, WEIGHED)[0])
    return weighed + body.weight(gravity or 0.0, water.density) + overpull


def lift_off_lacks(scene: Resolved) -> list[str]:
    """Fields that a scene lacks for lifting its LMRP off; empty if it has all."""
    if scene.lowest_riser_section:
        return ["an LMRP as bottom.body: in this scene, sections of the riser are below the flex joint"]
    missing = [] if scene.bottom.body else ["bottom.body"]
    return missing + ([] if scene.water else ["water"])
