"""Limits: what an output may be, in which mode of operation, and what a scene lacks to tell it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Literal, Self

from pydantic import model_validator

from riserstudy.scene.base import Strict
from riserstudy.scene.units import to_si

if TYPE_CHECKING:
    from riserstudy.scene.models import Scene
    from riserstudy.scene.riser import Section

#: outputs that may have a limit, and the unit that its text is read in
UNITS = {
    "effective_tension": "N",
    "bending_moment": "N*m",
    "shear_force": "N",
    "von_mises_stress": "N/m^2",
    "x": "m",
    "y": "m",
    "ufj_angle": "rad",
    "lfj_angle": "rad",
    "stroke": "m",
    "tensioner_stroke": "m",
    "tensioner_force": "N",
    "lower_end_tension": "N",
    "largest_stress": "N/m^2",
}
#: of which there is a value at every place along the riser
ALONG = ("effective_tension", "bending_moment", "shear_force", "von_mises_stress", "x", "y")
SIDES = ("largest", "smallest", "mean")
ENDS = ("lower end of ", "upper end of ")


class Limit(Strict):
    """An allowable of one output: its largest or smallest value, or its mean over time.

    Of outputs whose sign is a convention, such as moments and angles, the size is meant.
    ``at``: a section of the riser, or ``lower end of`` or ``upper end of`` one; absent: all along it. The
    allowable's origin is told as that of any other value.
    """

    output: str
    mode: Literal["drilling", "connected", "disconnect"]
    at: str | None = None
    largest: str | None = None
    smallest: str | None = None
    mean: str | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.output not in UNITS:
            raise ValueError(
                f"output {self.output!r} is none that has limits; allowed are " + ", ".join(UNITS)
            )
        if [self.largest, self.smallest, self.mean].count(None) != 2:
            raise ValueError("give one of largest, smallest and mean")
        if self.at is not None and self.output not in ALONG:
            raise ValueError(f"at: {self.output} has one place; allowed with " + ", ".join(ALONG))
        if self.mean is not None and self.output in ALONG and not (self.at or "").startswith(ENDS):
            raise ValueError(
                f"mean: of {self.output} at one place; allowed with 'at: {ENDS[0]}' a section"
            )
        if self.allowable == 0.0 and self.side != "smallest":
            raise ValueError(f"{self.side}: nothing has a use of 0; allowed is any other value")
        return self

    @property
    def side(self) -> str:
        """Which of largest, smallest and mean has the allowable."""
        return next(side for side in SIDES if getattr(self, side) is not None)

    @property
    def allowable(self) -> float:
        """In the SI unit of the output: N, N m, Pa, m or rad."""
        return to_si(getattr(self, self.side), UNITS[self.output])


def fits(scene: Scene) -> None:
    """See that limits are at sections that there are.

    Raises
    ------
    ValueError
        Field, what was found and what is allowed.
    """
    names = [section.name for section in scene.riser]
    for k, limit in enumerate(scene.limits or []):
        place = section_of(limit.at or names[0])
        if place not in names:
            raise ValueError(
                f"limits[{k}].at: no section {place!r}; allowed are " + ", ".join(map(repr, names))
            )


def section_of(place: str) -> str:
    """The section whose end, or all of which, a place is."""
    for end in ENDS:
        place = place.removeprefix(end)
    return place


def wall_lacks(scene: Scene, section: Section) -> list[str]:
    """What the stress of a section's wall lacks, by the fields of the scene; empty where it is known."""
    lacks = [
        f"{name} of section {section.name!r}"
        for name in ("outer_diameter", "inner_diameter")
        if not getattr(section, name)
    ]
    if scene.water is not None:
        lacks += [] if section.contents else [f"contents of section {section.name!r}"]
        lacks += ["water.surface"] if scene.water.surface is None else []
        lacks += ["gravity"] if scene.gravity is None else []
    return lacks


def lacks(scene: Scene, limit: Limit) -> list[str]:
    """What a scene lacks for the output of a limit, by its fields; empty where it should be there."""
    name = limit.output
    if name == "von_mises_stress":
        return [
            lack
            for section in scene.riser
            if limit.at is None or section_of(limit.at) == section.name
            for lack in wall_lacks(scene, section)
        ]
    needs: dict[str, tuple[str, Callable[[Scene], bool]]] = {
        "stroke": (
            "top.telescopic_joint or tensioners",
            lambda s: bool(s.top.telescopic_joint or s.top.tensioners),
        ),
        "tensioner_stroke": ("top.tensioners", lambda s: s.top.tensioners is not None),
        "tensioner_force": ("top.tensioners", lambda s: s.top.tensioners is not None),
        "largest_stress": ("analysis.output.stress_in", lambda s: bool(s.analysis.output)),
        "ufj_angle": ("top.x that is held, on the platform or a vessel", lambda s: bool(s.lateral)),
        "lfj_angle": ("a held lower end, or a riser.flex_joint_below", lambda s: bool(s.lateral)),
        "bending_moment": ("bending stiffness and a load across", lambda s: bool(s.lateral)),
        "shear_force": ("bending stiffness and a load across", lambda s: bool(s.lateral)),
    }
    field, given = needs.get(name, ("", lambda _: True))
    return [] if given(scene) else [field]
