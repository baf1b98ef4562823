"""How a platform answers waves: response amplitude operators times a wave or a sea."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE, Strict
from riserstudy.scene.sea import Storm, Swell

SHIFTS, TILTS = ("surge", "sway", "heave"), ("roll", "pitch", "yaw")
MOTIONS = (*SHIFTS, *TILTS)
Motion = Literal["surge", "sway", "heave", "roll", "pitch", "yaw"]
Shift = Annotated[u.Ratio, NOT_NEGATIVE] | None
Tilt = Annotated[u.AnglePerLength, NOT_NEGATIVE] | None


class Operator(Strict):
    """Response to waves of one period: a metre of wave amplitude gives so much, at a phase.

    An absent motion is none.
    """

    period: Annotated[u.Time, POSITIVE]
    surge: Shift = None
    surge_phase: u.Angle | None = None
    sway: Shift = None
    sway_phase: u.Angle | None = None
    heave: Shift = None
    heave_phase: u.Angle | None = None
    roll: Tilt = None
    roll_phase: u.Angle | None = None
    pitch: Tilt = None
    pitch_phase: u.Angle | None = None
    yaw: Tilt = None
    yaw_phase: u.Angle | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        for name in MOTIONS:
            if (getattr(self, name) is None) != (getattr(self, f"{name}_phase") is None):
                raise ValueError(f"{name} and {name}_phase go together")
        return self

    @property
    def motions(self) -> set[str]:
        """Names of the motions that it has."""
        return {name for name in MOTIONS if getattr(self, name) is not None}


class Response(Strict):
    """Platform motion from response amplitude operators, as points or a CSV table ``{file: name.csv}``.

    Phases lead or lag the crest of the wave at the platform, whose surface is amplitude cos(w t - phase)
    there. Absent wave: that of the scene; motions: all of the table; ramp: all at once.
    """

    operators: Annotated[list[Operator], Field(min_length=2)]
    phases: Literal["lead", "lag"]
    motions: Annotated[list[Motion], Field(min_length=1)] | None = None
    wave: Swell | Storm | None = None
    ramp: Annotated[u.Time, POSITIVE] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if any(a.period >= b.period for a, b in pairwise(self.operators)):
            raise ValueError("operators: periods must rise from line to line")
        if any(a.motions != b.motions for a, b in pairwise(self.operators)):
            raise ValueError("operators: every line must have the same motions")
        missing = set(self.motions or []) - self.operators[0].motions
        if missing:
            raise ValueError(f"motions: the operators have no {sorted(missing)[0]}")
        return self

    @property
    def moving(self) -> list[str]:
        """Names of the motions that it gives, in order."""
        wanted = set(self.motions) if self.motions else self.operators[0].motions
        return [name for name in MOTIONS if name in wanted]
