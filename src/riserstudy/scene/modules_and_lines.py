"""Attachments to the pipe of a joint: buoyancy modules, choke and kill lines.

Their mass, weight and stiffness are given separately from the pipe, and added when the scene is resolved.
"""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE, WHOLE


class Modules(Strict):
    """Buoyancy modules of one riser joint.

    Mass and lift of buoyancy modules are values for one joint of the section. In a section without
    ``joints``, mass and lift of the modules are values for the whole section.

    The key ``lift`` is the lift of the modules in water, minus the weight of the modules. For modules above
    the water, the engine computes the weight as mass times gravity.
    """

    mass: Annotated[u.Mass, POSITIVE]
    lift: Annotated[u.Force, NOT_NEGATIVE]


class Line(Strict):
    """One or several equal small pipes along the riser pipe, such as choke, kill, booster or hydraulic lines.

    The key ``count`` of a line is the number of equal lines, by default 1. Give the mass of one line, or
    ``wall_density``, from which the engine computes the mass. The key ``contents`` is the density of the
    fluid inside the line, which moves with the line; without the key ``contents``, the line is empty. Lines
    with a ``young_modulus`` bend together with the pipe, each about its own axis. With ``tension: shared``,
    pipe and lines share the tension in proportion to their axial stiffnesses. With ``tension: sliding``, the
    ends of the lines slide along the pipe, and the lines carry no tension. In reality, the pressure in a line
    changes the tension of the pipe; the engine neglects this change.
    """

    name: str
    count: Annotated[int, Field(ge=1, le=100), WHOLE] | None = None
    outer_diameter: Annotated[u.Length, POSITIVE]
    inner_diameter: Annotated[u.Length, NOT_NEGATIVE]
    mass: Annotated[u.MassPerLength, POSITIVE] | None = None
    wall_density: Annotated[u.Density, POSITIVE] | None = None
    contents: Annotated[u.Density, POSITIVE] | None = None
    young_modulus: Annotated[u.Modulus, POSITIVE] | None = None
    tension: Literal["shared", "sliding"] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        check_wall(self.outer_diameter, self.inner_diameter)
        if (self.mass is None) == (self.wall_density is None):
            raise Misfit("", "mass or wall_density is required, not both", "give one of them")
        if (self.young_modulus is None) != (self.tension is None):
            raise Misfit(
                "",
                "only one of young_modulus and tension is given",
                "give both (tension: 'shared' or 'sliding')",
            )
        return self

    @property
    def number(self) -> int:
        """Number of lines."""
        return self.count or 1

    @property
    def wall_area(self) -> float:
        """Cross section of the walls of all lines together (m2)."""
        return self.number * disc(self.outer_diameter) - self.number * disc(self.inner_diameter)

    @property
    def all_mass(self) -> float:
        """Mass of all lines together, with their contents (kg/m)."""
        own = (self.wall_density or 0.0) * self.wall_area + self.number * (self.mass or 0.0)
        return own + (self.contents or 0.0) * self.number * disc(self.inner_diameter)

    @property
    def outside(self) -> float:
        """Cross section that all lines together displace (m2)."""
        return self.number * disc(self.outer_diameter)

    @property
    def elasticity(self) -> tuple[float, float]:
        """EA (N) and EI (N m2) that all lines together add to the pipe."""
        modulus = self.young_modulus or 0.0
        second = math.pi / 64.0 * (self.outer_diameter**4 - self.inner_diameter**4)
        axial = modulus * self.wall_area if self.tension == "shared" else 0.0
        return axial, modulus * self.number * second


def check_wall(outer: float, inner: float) -> None:
    """Check that a pipe with these diameters (m) has a wall. Raises Misfit otherwise."""
    if inner >= outer:
        found = f"inner_diameter {inner:g} m is not smaller than outer_diameter {outer:g} m"
        raise Misfit("", found, "correct one of them")


def disc(diameter: float) -> float:
    """Area (m2) of a circle with a diameter (m)."""
    return 0.25 * math.pi * diameter**2
