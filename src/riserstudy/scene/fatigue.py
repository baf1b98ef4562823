"""Fatigue: details of the wall, their S-N curves and their places."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple, Self

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.plain_yaml import read_yaml
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import POSITIVE, WHOLE
from riserstudy.scene.limits import ENDS, place_of, sections_at

DATA_FILES = ("sn_curves.yaml",)
A_PERIOD = 8  # smallest number of outputs in a period: with fewer, outputs miss the peaks of stress


class SNCurve(NamedTuple):
    """Lines log10 N = log_a - m log10 S, S in MPa; at each S the line with more cycles N applies."""

    exponents: tuple[float, ...]  # one or two, rising
    log_a: tuple[float, ...]
    reference_thickness: float  # m
    thickness_exponent: float

    def times(self, thickness: float) -> float:
        """Factor (1) on the stress range for a thickness (m); 1 up to the reference thickness."""
        over = max(thickness / self.reference_thickness, 1.0)
        return math.pow(over, self.thickness_exponent)


class Slope(Strict):
    """A slope of an S-N curve: log10(cycles to failure) = log_a - exponent log10(stress range in MPa)."""

    exponent: Annotated[float, POSITIVE]
    log_a: Annotated[float, Field(gt=0, lt=40)]


class OwnCurve(Strict):
    """Your own S-N curve with one or two slopes; the slope with more cycles to failure applies.

    For a detail thicker than ``reference_thickness``, the engine multiplies the stress range by (thickness /
    reference_thickness)^thickness_exponent.
    """

    slopes: Annotated[list[Slope], Field(min_length=1, max_length=2)]
    reference_thickness: Annotated[u.Length, POSITIVE]
    thickness_exponent: Annotated[float, Field(ge=0, le=1)]

    @model_validator(mode="after")
    def _rising(self) -> Self:
        exponents = [slope.exponent for slope in self.slopes]
        if exponents != sorted(set(exponents)):
            raise Misfit(
                "slopes",
                "the exponent does not increase from the first slope to the second",
                "list the slope for large stress ranges first, which has the smaller exponent",
            )
        return self

    @property
    def numbers(self) -> SNCurve:
        """What damage is computed with."""
        return SNCurve(
            tuple(slope.exponent for slope in self.slopes),
            tuple(slope.log_a for slope in self.slopes),
            self.reference_thickness,
            self.thickness_exponent,
        )


class StandardCurve(Strict):
    """An S-N curve of DNV-RP-C203, selected by its class (B1 to W3) and its environment.

    The file ``scene/sn_curves.yaml`` of the package contains the numbers of the S-N curves and their source.
    Editions of DNV-RP-C203 differ, so compare the curves of riserstudy with the edition of DNV-RP-C203 that
    you must use. If the S-N curves of riserstudy differ from your edition of DNV-RP-C203, give your own curve
    (``OwnCurve``).
    """

    detail_class: str
    environment: Literal["air", "seawater with cathodic protection"]

    @model_validator(mode="after")
    def _known(self) -> Self:
        if self.detail_class not in (known := sn_curves()["curves"]):
            found = f"detail_class {self.detail_class!r} is not a class of DNV-RP-C203"
            raise Misfit("", found, f"use one of {', '.join(known)}")
        return self

    @property
    def numbers(self) -> SNCurve:
        """What damage is computed with."""
        table = sn_curves()
        row = dict(zip(table["columns"], table["curves"][self.detail_class], strict=True))
        first = row["log_a_air" if self.environment == "air" else "log_a_seawater"]
        return SNCurve(
            (row["first_exponent"], row["second_exponent"]),
            (first, row["log_a_second"]),
            u.to_si(table["reference_thickness"], "m"),
            row["thickness_exponent"],
        )


class Detail(Strict):
    """A detail whose fatigue damage is computed: welds of the wall, a connector, a weld of the wellhead.

    The key ``at`` gives the sections of the riser with a fatigue detail, in the form of the key ``at`` in
    ``limits``. By default, all sections have the fatigue detail. The key ``face`` selects the inner or outer
    face of the wall. For a fatigue detail, the engine computes the stress due to wall tension and bending at
    this face. For a detail at one end of a section, give ``stress_per_moment`` instead of ``face``. The key
    ``stress_per_moment`` is the stress in the detail divided by the bending moment at this end of the
    section. For example, ``stress_per_moment: 0.02 MPa/kN/m`` means 0.02 MPa for each kN m. With
    ``stress_per_moment``, the stress due to tension is neglected. The engine multiplies the computed nominal
    stress of a detail by ``stress_concentration``. The default of the key ``thickness`` of a detail is the
    wall thickness of the section; with ``stress_per_moment``, you must give ``thickness``. The factored
    damage of a detail is the damage times ``safety_factor``.
    """

    name: Annotated[str, Field(min_length=1)]
    at: str | Annotated[list[str], Field(min_length=2, max_length=2)] | None = None
    face: Literal["outside", "inside"] | None = None
    stress_per_moment: Annotated[u.StressPerMoment, POSITIVE] | None = None
    curve: StandardCurve | OwnCurve
    stress_concentration: Annotated[float, POSITIVE]
    thickness: Annotated[u.Length, POSITIVE] | None = None
    safety_factor: Annotated[float, Field(ge=1)]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.face is None) == (self.stress_per_moment is None):
            raise Misfit("", "face or stress_per_moment is required, not both", "give one of them")
        if self.stress_per_moment and not place_of(self.at).startswith(ENDS):
            raise Misfit(
                "stress_per_moment",
                "applies to the end of a section only",
                f"give the end of a section, such as 'at: {ENDS[0]}' followed by the name of a section",
            )
        if self.stress_per_moment and self.thickness is None:
            raise Misfit("", "stress_per_moment requires the thickness of the detail", "add thickness")
        return self

    def sections(self, names: Sequence[str]) -> list[str]:
        """Names of the sections with this detail, of all ``names`` from below; ValueError if none has it."""
        return sections_at(self.at, names)


class Fatigue(Strict):
    """Fatigue damage of details, from stress cycles (rainflow counting), S-N curves and Miner's sum.

    The key ``angles`` is the number of places around the wall for which the engine computes damage. The first
    of the places around the wall is on the side of the positive x axis. Between two neighbouring places
    around the wall, the damage can be larger than at both places, by a factor of at most cos(pi / angles)^-m.
    The exponent m of the largest ratio is the exponent of the S-N curve.
    """

    angles: Annotated[int, Field(ge=8, le=72, multiple_of=4), WHOLE]
    details: Annotated[list[Detail], Field(min_length=1)]


@cache
def sn_curves() -> dict[str, Any]:
    """The table of S-N curves, with its source and edition."""
    table: dict[str, Any] = read_yaml(Path(__file__).with_name(DATA_FILES[0]))
    return table
