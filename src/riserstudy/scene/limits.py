"""Limits: the allowable value of an output, and the mode of operation that it applies to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any, Literal, Self

from pydantic import Field, field_validator, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene.quantities import QUANTITIES
from riserstudy.scene.units import to_si

#: outputs that may have a limit, with the SI unit that the text of the limit is converted to
UNITS = {name: of.limit_unit for name, of in QUANTITIES.items() if of.limit_unit}
ANGLES = tuple(output for output, unit in UNITS.items() if unit == "rad")
STROKES = tuple(output for output in UNITS if QUANTITIES[output].errors == ("stroke",))
#: outputs of one place, or of all cylinders together, whose error is one number: by its key
OF_ONE_PLACE = {
    **{angle: (angle,) for angle in ANGLES},
    "stroke": STROKES,
    "tensioner_force": ("tensioner_force",),
}
#: outputs whose sign is a convention: their limits apply to the magnitude
SIGNED = tuple(output for output in UNITS if QUANTITIES[output].sign_is_convention)
#: outputs that have a value at every place along the riser
ALONG = tuple(name for name in UNITS if QUANTITIES[name].along)
#: outputs of which a limit without a place covers only the riser: stack and conductor are of other steel and
#: stand on the seabed
OF_THE_RISER = ("effective_tension", "von_mises_stress")
#: results of a disconnect itself
OF_A_DISCONNECT = ("overpull", "lmrp_clearance")
SIDES = ("largest", "smallest", "mean")
ENDS = ("lower end of ", "upper end of ")
ABOVE = ", above water"  # suffix to the name of a section, for its part above the water surface


class Limit(Strict):
    """Limit on one output: the largest or smallest allowed value, or the largest allowed mean over time.

    The key ``output`` can name an output along the riser (``effective_tension``, ``bending_moment``,
    ``shear_force``, ``von_mises_stress``, ``x`` or ``y``). Other outputs that can have a limit are
    ``lower_end_tension``, ``ufj_angle``, ``lfj_angle``, ``stroke``, ``joint_stroke``, ``tensioner_stroke``,
    ``tensioner_force`` and ``largest_stress``. In a scene with a disconnect, the outputs ``overpull`` and
    ``lmrp_clearance`` can also have a limit. The page on variables of datasets explains the outputs. The
    output ``largest_stress`` neglects the pressures of contents and sea; ``von_mises_stress`` includes these
    pressures. A stress range cannot have a limit; the key ``fatigue`` computes damage from stress ranges. The
    clearance of the riser in a moonpool (an opening through the hull) also cannot have a limit.

    The key ``mode`` states in which operation a limit must be met. A limit of the mode ``drilling`` applies
    only while drilling. A limit of the mode ``connected`` applies as long as the riser is connected, with or
    without drilling. A limit of the mode ``disconnect`` must always be met; the riser must disconnect before
    this limit is exceeded.

    For moments, shear forces, angles, x and y, the sign is a convention, so the limit applies to the
    magnitude. A limit on a magnitude cannot have the key ``smallest`` or a negative allowed value. The key
    ``at`` gives the place where a limit applies: a section (its name), or an end of a section (``lower end
    of`` or ``upper end of``, followed by the name). For a group of consecutive sections, give the names of
    the lowest and the highest section (``[lowest, highest]``). By default, a limit applies to the whole
    riser. By default, limits on tension and stress do not apply to the stack and the conductor below the flex
    joint. A disconnect in a run ends the operations of the modes ``drilling`` and ``connected``, so their
    limits apply until the disconnect, except limits on ``overpull`` and ``lmrp_clearance``. A limit of the
    mode ``disconnect`` includes the time after the disconnect. A disconnect opens the lower flex joint, so a
    limit of any mode on the lower flex joint angle applies only until the disconnect. A smallest allowed
    ``tensioner_force`` does not apply to cylinders that have failed. The allowable value of a limit can have
    an origin, like any other value of a scene.
    """

    output: str
    mode: Literal["drilling", "connected", "disconnect"]
    at: str | Annotated[list[str], Field(min_length=2, max_length=2)] | None = None
    largest: str | None = None
    smallest: str | None = None
    mean: str | None = None

    @field_validator("largest", "smallest", "mean", mode="before")
    @classmethod
    def _has_a_unit(cls, given: Any) -> Any:
        if isinstance(given, int | float):
            raise Misfit("", f"{given} has no unit", "write a value with a unit, such as '5 deg' or '100 kN'")
        return given

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.output not in UNITS:
            allowed = f"use one of {', '.join(UNITS)}"
            raise Misfit("output", f"{self.output!r} is not an output that can have a limit", allowed)
        if [self.largest, self.smallest, self.mean].count(None) != 2:
            raise Misfit("", "a limit has exactly one of largest, smallest and mean", "give one")
        if self.at is not None and self.output not in ALONG:
            allowed = f"remove it; 'at' is only for {', '.join(ALONG)}"
            raise Misfit("at", f"{self.output} already belongs to one place", allowed)
        if self.mean is not None and self.output in ALONG and not self.place.startswith(ENDS):
            raise Misfit(
                "mean",
                f"a limit on the mean of {self.output} requires one place",
                f"give the end of a section, such as 'at: {ENDS[0]}' followed by the name of a section",
            )
        if self.output in SIGNED and (self.smallest is not None or self.allowable < 0.0):
            found = "a smallest value" if self.smallest is not None else "a negative value"
            found = f"limits on {self.output} apply to its magnitude, for which {found} has no meaning"
            raise Misfit(self.side, found, "use largest or mean, with a positive value")
        if self.allowable == 0.0 and self.side != "smallest":
            found = "with an allowable value of 0, the utilisation cannot be computed"
            raise Misfit(self.side, found, "give a value other than 0")
        return self

    @property
    def place(self) -> str:
        """The place that it applies to, in words; "" for the whole riser."""
        return place_of(self.at)

    def sections(self, names: Sequence[str]) -> list[str]:
        """Names of the sections that it applies to, of all ``names`` from below.

        Raises ValueError when there is no such section, or the last of several is below the first.
        """
        return sections_at(self.at, names)

    def places(self, names: Sequence[str]) -> list[str]:
        """Places that it applies to, named as in the extremes of runs."""
        if not self.at:
            return ["", *names]
        end = next((end for end in ENDS if self.place.startswith(end)), "")
        sections = self.sections(names)
        return [end + sections[-1 if end == ENDS[1] else 0]] if end else sections

    @property
    def side(self) -> str:
        """The one of ``largest``, ``smallest`` and ``mean`` that is given."""
        return next(side for side in SIDES if getattr(self, side) is not None)

    @property
    def ends_with_disconnect(self) -> bool:
        """Whether it does not apply after a disconnect, which ends the operations of a connected riser."""
        return ends_with_disconnect(self.mode, self.output)

    @property
    def allowable(self) -> float:
        """The allowable in the SI unit of the output: N, N m, Pa, m or rad."""
        return to_si(getattr(self, self.side), UNITS[self.output])


def ends_with_disconnect(mode: str | None, output: str) -> bool:
    """Whether a limit of a mode on an output does not apply after a disconnect."""
    return mode != "disconnect" and output not in OF_A_DISCONNECT


def place_of(at: str | list[str] | None) -> str:
    """A place along the riser in words; "" for all of it."""
    return " to ".join(at) if isinstance(at, list) else at or ""


def sections_at(at: str | list[str] | None, names: Sequence[str]) -> list[str]:
    """Names of the sections that belong to a place, of all ``names`` from below.

    Raises ValueError when there is no such section, or the last of several is below the first.
    """
    ends = at if isinstance(at, list) else [section_of(at or "")]
    if not at:
        return list(names)
    if missing := [end for end in ends if end not in names]:
        found = f"the riser has no section {missing[0]!r}"
        raise Misfit("", found, f"use one of {', '.join(map(repr, names))}")
    first, last = names.index(ends[0]), names.index(ends[-1])
    last += names[last] + ABOVE in names
    if first > last:
        raise Misfit("", f"{ends[0]!r} is above {ends[-1]!r}", "name the lowest section first")
    return list(names[first : last + 1])


def section_of(place: str) -> str:
    """The section named by a place, which is the whole section or one of its ends."""
    for end in ENDS:
        place = place.removeprefix(end)
    return place
