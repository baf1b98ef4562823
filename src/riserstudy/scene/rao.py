"""Platform motion in waves: response amplitude operators times a wave or a sea."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Annotated, Literal, NamedTuple, Self

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE
from riserstudy.scene.sea import Storm, Swell, Wave

PLURAL = {"period": "periods", "frequency": "frequencies"}
SHIFTS, TILTS = ("surge", "sway", "heave"), ("roll", "pitch", "yaw")
MOTIONS = (*SHIFTS, *TILTS)
Motion = Literal["surge", "sway", "heave", "roll", "pitch", "yaw"]
Shift = Annotated[u.Ratio, NOT_NEGATIVE] | None
Tilt = Annotated[u.AnglePerLength, NOT_NEGATIVE] | None


class Operator(Strict):
    """Response of the platform to waves of one period or frequency: motion per wave amplitude, and phase.

    The frequencies of RAOs are in Hz or rad/s. A platform motion without RAOs is zero. The heading of an RAO
    is the direction of the waves, measured from x towards y. RAOs without headings apply to waves from all
    directions.
    """

    heading: u.Angle | None = None
    period: Annotated[u.Time, POSITIVE] | None = None
    frequency: Annotated[u.Frequency, POSITIVE] | None = None
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
        if (self.period is None) == (self.frequency is None):
            raise Misfit("", "period or frequency is required, not both", "give one of them")
        for name in MOTIONS:
            if (getattr(self, name) is None) != (getattr(self, f"{name}_phase") is None):
                raise Misfit("", f"only one of {name} and {name}_phase is given", "give both, or neither")
        return self

    @property
    def circular(self) -> float:
        """Circular frequency of the waves (rad/s)."""
        return self.frequency or 2.0 * math.pi / (self.period or math.inf)

    @property
    def motions(self) -> set[str]:
        """Names of the motions that it has."""
        return {name for name in MOTIONS if getattr(self, name) is not None}


class Mirror(NamedTuple):
    """A plane of symmetry: the mirror image of a heading is ``turn`` minus the heading."""

    turn: float  # rad
    reversed: tuple[str, ...]  # motions that change their sign

    def image(self, heading: float) -> float:
        """Heading of the mirrored waves (rad)."""
        return math.remainder(self.turn - heading, 2.0 * math.pi)

    def mirrored(self, row: Operator) -> Operator:
        """The operator for the mirrored waves: motions that change sign are half a turn later."""
        phases = {f"{name}_phase": getattr(row, f"{name}_phase") for name in self.reversed}
        turned = {name: phase + math.pi for name, phase in phases.items() if phase is not None}
        return row.replaced(**turned)


SIDES = Mirror(0.0, ("sway", "roll", "yaw"))
ENDS = Mirror(math.pi, ("surge", "pitch", "yaw"))
MIRRORS = {None: 0, "sides": 1, "sides and ends": 2}


WIDEST = 0.5 * math.pi  # largest gap between headings over which operators are interpolated (rad)
NEAR = 1e-9  # rad, distance from a heading within which its operators are not interpolated
CLOSE = 1e-6  # headings closer than this (rad) are equal, and frequencies closer than this share


def _same(one: float | None, other: float | None) -> bool:
    """Whether two headings (rad) are equal, such as 0 and 360 deg, or -180 and 180 deg."""
    if one is None or other is None:
        return one is other
    return abs(math.remainder(one - other, 2.0 * math.pi)) < CLOSE


class Response(Strict):
    """Platform motion from response amplitude operators (RAOs), given as a list or as a CSV table.

    To give a CSV table of RAOs, write ``operators: {file: name.csv}``. The key ``phases`` states whether the
    phases of the RAOs are leads or lags, relative to a wave crest at the platform. The surface elevation at
    the platform is A cos(w t - p), with the wave amplitude A, the angular frequency w and the phase p. In the
    surface elevation at the platform, p is the phase of the wave that the key ``wave`` of ``response`` gives.
    If the key ``wave`` of the scene gives the wave, p is the phase of this wave plus k x, with the wave
    number k. In the phase k x, x is the platform's position in the direction of the wave, including its
    offset at rest and the distance covered by a cruise. The key ``headings`` states whether the headings of
    RAOs are directions that waves travel to (``towards``) or come from (``from``). Between headings, RAOs are
    interpolated linearly. The rows of a table of RAOs can be in any order. With ``symmetry``, the engine
    mirrors the RAOs at a given heading to obtain the RAOs at a missing heading. With ``symmetry: sides``, the
    RAOs are mirrored in the x-z plane. With ``symmetry: sides and ends``, the RAOs are also mirrored in the
    y-z plane. The key ``beyond`` defines the response of the platform to waves with periods outside the range
    of the RAOs. With ``beyond: hold``, the engine uses the RAOs at the nearest end of the range of periods.
    With ``beyond: zero``, the platform does not respond to waves outside the range. By default (``beyond:
    refuse``), the engine refuses waves with periods outside the range of the RAOs. A warning states the share
    of the wave energy outside the range of the RAOs. By default, the platform responds to the wave of the
    scene, without a ramp, in all motions for which RAOs are given. A wave that is given in ``response``
    travels along x by default. If the RAOs of a motion are zero for the direction of the waves, the platform
    does not move in this motion. With a table of all six motions, a riser in head seas can therefore be
    computed in a plane.
    """

    operators: Annotated[list[Operator], Field(min_length=2)]
    phases: Literal["lead", "lag"]
    headings: Literal["towards", "from"] | None = None
    symmetry: Literal["sides", "sides and ends"] | None = None
    beyond: Literal["hold", "zero", "refuse"] | None = None
    motions: Annotated[list[Motion], Field(min_length=1)] | None = None
    wave: Swell | Storm | None = None
    heading: u.Angle | None = None
    ramp: Annotated[u.Time, POSITIVE] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        tables = list(self.by_heading.values())
        kinds = {row.period is None for row in self.operators}
        if len(kinds) > 1:
            raise Misfit(
                "operators",
                "some lines have a period, others a frequency",
                "give period in every line, or frequency in every line",
            )
        kind = "frequency" if kinds == {True} else "period"
        for heading, rows in self.by_heading.items():
            if twice := [a for a, b in pairwise(rows) if _one_frequency(a, b)]:
                raise Misfit(
                    "operators",
                    f"a {kind} occurs twice, {_place_of(twice[0])}{_at(heading, self.headings)}",
                    f"give each {kind} once per heading; headings that differ by 360 deg are the same",
                )
        if len(tables[0]) < 2 or any(not _same_frequencies(t, tables[0]) for t in tables):
            raise Misfit(
                "operators",
                f"the headings have different {PLURAL[kind]}, or only one",
                f"give the same {PLURAL[kind]} for every heading, at least two",
            )
        self._check_headings()
        if any(a.motions != b.motions for a, b in pairwise(self.operators)):
            raise Misfit(
                "operators", "the lines have different motions", "give the same motions in every line"
            )
        given = self.motions or []
        if again := next((name for k, name in enumerate(given) if name in given[:k]), None):
            raise Misfit("motions", f"{again} occurs twice", "give each motion once")
        missing = set(given) - self.operators[0].motions
        if missing:
            raise Misfit(
                "motions",
                f"the operators have no column for {sorted(missing)[0]}",
                "remove it from motions, or add it to the operators",
            )
        return self

    def _check_headings(self) -> None:
        if len(self.by_heading) > 1 and None in self.by_heading:
            raise Misfit(
                "operators", "only some lines have a heading", "give heading in every line or in none"
            )
        if (self.headings is None) != (None in self.by_heading):
            raise Misfit(
                "headings",
                *(
                    ("missing, but the operators have headings", "write 'towards' or 'from'")
                    if self.headings is None
                    else ("the operators have no headings", "remove it, or give heading in every line")
                ),
            )
        if self.symmetry and self.headings is None:
            raise Misfit(
                "symmetry", "the operators have no headings", "remove it, or give heading in every line"
            )
        if self.heading is not None and self.wave is None:
            raise Misfit(
                "heading", "the wave of the scene defines the heading", "remove heading from the response"
            )
        if self.heading is not None and self.headings is None:
            raise Misfit(
                "heading",
                "the operators have no headings and apply to waves of any heading",
                "remove heading, or give heading in every line of the operators",
            )

    @property
    def by_heading(self) -> dict[float | None, list[Operator]]:
        """Operators by the direction that waves travel to (rad; None: any), in order of frequency.

        Headings that differ by a full turn are equal.
        """
        turn = math.pi if self.headings == "from" else 0.0
        tables: dict[float | None, list[Operator]] = {}
        for row in sorted(self.operators, key=lambda row: (row.circular, row.heading or 0.0)):
            towards = None if row.heading is None else row.heading + turn
            known = next((known for known in tables if _same(known, towards)), towards)
            tables.setdefault(known, []).append(row)
        for plane in (SIDES, ENDS)[: MIRRORS[self.symmetry]]:
            there = [heading for heading in tables if heading is not None]
            for heading in there:
                image, rows = plane.image(heading), tables[heading]
                if not any(_same(known, image) for known in tables):
                    tables[image] = [plane.mirrored(row) for row in rows]
        return tables

    @property
    def moving(self) -> list[str]:
        """Names of the motions that it gives, in their usual order."""
        wanted = set(self.motions) if self.motions else self.operators[0].motions
        return [name for name in MOTIONS if name in wanted]

    def around(self, heading: float) -> list[tuple[float, list[Operator]]]:
        """Operators at one or two headings with their weights, of which the operators at a heading (rad) are.

        Empty if no two headings close enough enclose it.
        """
        tables = self.by_heading
        if None in tables:
            return [(1.0, tables[None])]
        turns = {
            math.remainder(known, 2.0 * math.pi) + turn: rows
            for known, rows in tables.items()
            if known is not None
            for turn in (-2.0 * math.pi, 0.0, 2.0 * math.pi)
        }
        heading = math.remainder(heading, 2.0 * math.pi)
        below = max((known for known in turns if known <= heading + NEAR), default=math.nan)
        above = min((known for known in turns if known >= heading - NEAR), default=math.nan)
        if not above - below <= WIDEST + NEAR:
            return []
        if above - below <= NEAR:
            return [(1.0, turns[below])]
        share = (heading - below) / (above - below)
        return [(weight, turns[at]) for weight, at in ((1.0 - share, below), (share, above))]

    def heading_of(self, wave: Wave | Swell | Storm | None) -> float:
        """Direction in which the wave travels (rad); that of a wave in the response is in the response."""
        return (wave.heading if isinstance(wave, Wave) else self.heading) or 0.0

    def moves_in(self, wave: Wave | Swell | Storm | None) -> list[str]:
        """Names of the motions that are not zero in a wave, in their usual order."""
        parts = self.around(self.heading_of(wave))
        rows = [row for weight, of in parts if weight for row in of] or self.operators
        return [name for name in self.moving if any(getattr(row, name) for row in rows)]


def _one_frequency(one: Operator, other: Operator) -> bool:
    return math.isclose(one.circular, other.circular, rel_tol=CLOSE)


def _same_frequencies(some: list[Operator], others: list[Operator]) -> bool:
    return len(some) == len(others) and all(map(_one_frequency, some, others))


def _place_of(row: Operator) -> str:
    """The wave of an operator in words."""
    return f"{row.circular:g} rad/s" if row.period is None else f"{row.period:g} s"


def _at(towards: float | None, headings: str | None) -> str:
    """A heading in words, in the convention of the operators (towards or from)."""
    if towards is None:
        return ""
    given = towards - (math.pi if headings == "from" else 0.0)
    return f" at heading {math.degrees(given):g} deg"
