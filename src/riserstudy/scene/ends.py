"""What holds the riser's ends and what is attached to them."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import model_validator

from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE, Strict
from riserstudy.scene.tensioners import Tensioners


class Areas(Strict):
    """Drag areas C_D A of a body. An absent direction has no drag."""

    horizontal: Annotated[u.Area, NOT_NEGATIVE] | None = None
    vertical: Annotated[u.Area, NOT_NEGATIVE] | None = None


class BodyAddedMass(Strict):
    """Added mass of a body. An absent direction has none."""

    horizontal: Annotated[u.Mass, NOT_NEGATIVE] | None = None
    vertical: Annotated[u.Mass, NOT_NEGATIVE] | None = None


class Body(Strict):
    """A concentrated mass: LMRP, tension ring. Absent weight, drag, added mass: none.

    Its weight in water is given, or follows from mass, gravity and the volume of water it displaces.
    """

    name: str
    mass: Annotated[u.Mass, NOT_NEGATIVE]
    submerged_weight: u.Force | None = None
    displaced_volume: Annotated[u.Volume, NOT_NEGATIVE] | None = None
    drag_area: Areas | None = None
    added_mass: BodyAddedMass | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.submerged_weight is not None and self.displaced_volume is not None:
            raise ValueError("give submerged_weight or displaced_volume, not both")
        return self

    def weight(self, gravity: float, water: float) -> float:
        """Weight in water of a density (N)."""
        if self.displaced_volume is None:
            return self.submerged_weight or 0.0
        return (self.mass - water * self.displaced_volume) * gravity


class FlexJoint(Strict):
    """Rotational spring between riser and what holds it."""

    stiffness: Annotated[u.RotationalStiffness, NOT_NEGATIVE]


Rotation = Literal["free", "fixed"] | FlexJoint


class Bottom(Strict):
    """Lower end: held at the wellhead, or free."""

    hold: Literal["wellhead", "free"]
    elevation: u.Length | None = None
    rotation: Rotation | None = None
    body: Body | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.hold == "wellhead" and self.elevation is None:
            raise ValueError("a held bottom needs its elevation")
        if self.hold == "free" and (self.elevation is not None or self.rotation is not None):
            raise ValueError("a free bottom has neither elevation nor rotation of its own")
        return self


class Top(Strict):
    """Upper end. ``x`` and ``z`` follow the platform, are held at rest, or are free.

    Absent offset, elevation: straight above the bottom, where statics puts it. Absent tension, force,
    tensioners, body: none. ``held_at_tension``: z is held where the riser has this top tension at rest.
    """

    x: Literal["platform", "held", "free"] | None = None
    z: Literal["platform", "held", "free"]
    offset: u.Length | None = None
    elevation: u.Length | None = None
    held_at_tension: Annotated[u.Force, POSITIVE] | None = None
    tension: Annotated[u.Force, POSITIVE] | None = None
    lateral_force: u.Force | None = None
    rotation: Rotation | None = None
    body: Body | None = None
    tensioners: Tensioners | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.elevation is not None and self.held_at_tension is not None:
            raise ValueError("give elevation or held_at_tension, not both")
        if self.z == "free" and (self.elevation is not None or self.held_at_tension is not None):
            raise ValueError(
                "elevation and held_at_tension need a z that is held or on the platform"
            )
        if self.z != "free" and (self.tension is not None or self.tensioners is not None):
            raise ValueError("tension and tensioners need 'z: free'")
        if self.x != "free" and self.lateral_force is not None:
            raise ValueError("lateral_force needs 'x: free'")
        return self
