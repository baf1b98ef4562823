"""What holds the riser's ends and what is attached to them."""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE
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

    Its weight in water is given, or follows from mass, gravity and the volume of water it displaces, or the
    density of what it is made of.
    Absent centre_below: a point at the riser's end. With it the body turns rigidly with the lower end,
    its centre that far below; absent rotary_inertia about the centre, for axes across the riser: none.
    """

    name: str
    mass: Annotated[u.Mass, NOT_NEGATIVE]
    submerged_weight: u.Force | None = None
    displaced_volume: Annotated[u.Volume, NOT_NEGATIVE] | None = None
    density: Annotated[u.Density, POSITIVE] | None = None
    drag_area: Areas | None = None
    added_mass: BodyAddedMass | None = None
    centre_below: Annotated[u.Length, POSITIVE] | None = None
    rotary_inertia: Annotated[u.MomentOfInertia, POSITIVE] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if [self.submerged_weight, self.displaced_volume, self.density].count(None) < 2:
            raise ValueError("give one of submerged_weight, displaced_volume and density")
        if self.rotary_inertia is not None and self.centre_below is None:
            raise ValueError("rotary_inertia needs centre_below")
        if self.centre_below is not None and not self.horizontal_mass:
            raise ValueError("centre_below needs mass or added_mass.horizontal")
        return self

    @property
    def horizontal_mass(self) -> float:
        """Mass with added mass (kg)."""
        return self.mass + ((self.added_mass and self.added_mass.horizontal) or 0.0)

    @property
    def reach(self) -> float:
        """Distance from the riser's end to the centre of percussion (m), 0 for a point.

        Two masses, at the end and there, with the same sum and centre have the same rotary inertia.
        """
        if self.centre_below is None:
            return 0.0
        return self.centre_below + (self.rotary_inertia or 0.0) / (
            self.horizontal_mass * self.centre_below
        )

    @property
    def weightless(self) -> bool:
        """Whether nothing tells its weight."""
        return self.submerged_weight is None and self.displaced_volume is self.density is None

    def weight(self, gravity: float, water: float) -> float:
        """Weight in water of a density (N)."""
        displaced = self.mass / self.density if self.density else self.displaced_volume
        if displaced is None:
            return self.submerged_weight or 0.0
        return (self.mass - water * displaced) * gravity


class FlexJoint(Strict):
    """Rotational spring between riser and what holds it."""

    stiffness: Annotated[u.RotationalStiffness, NOT_NEGATIVE]


Rotation = Literal["free", "fixed"] | FlexJoint


class Bottom(Strict):
    """Lower end: held at the wellhead, free, or the foot of a conductor, held in z and by soil."""

    hold: Literal["wellhead", "free", "foot"]
    elevation: u.Length | None = None
    rotation: Rotation | None = None
    body: Body | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.hold != "free" and self.elevation is None:
            raise ValueError("a held bottom needs its elevation")
        if self.hold == "free" and (self.elevation is not None or self.rotation is not None):
            raise ValueError("a free bottom has neither elevation nor rotation of its own")
        if self.hold != "free" and self.body and self.body.centre_below:
            raise ValueError("body.centre_below needs 'hold: free'")
        return self


class JointStop(Strict):
    """Stops of a telescopic joint: how far it goes out and in from its length, and their stiffness.

    ``stroke``: outwards; ``collapse``: inwards, where the barrels meet and push. Absent: none that way. Both
    are elastic: what touches leaves as fast as it came.
    """

    stroke: Annotated[u.Length, POSITIVE] | None = None
    collapse: Annotated[u.Length, POSITIVE] | None = None
    stiffness: Annotated[u.Stiffness, POSITIVE]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.stroke is None and self.collapse is None:
            raise ValueError("needs stroke (outwards), collapse (inwards) or both")
        return self


class TelescopicJoint(Strict):
    """Joint above the tension ring that slides without force, and carries shear and bending.

    ``length`` is from ring to top with the platform at rest; outer and inner barrel bend as one.
    ``tension``: tensioners pull with it along the joint, whatever its length. Absent stop: none. The mass
    of the outer barrel is that of ``top.body``, at the ring; the inner one moves with the platform. Stops
    of the joint and the ``stroke`` of tensioners are apart: a rig may have both.

    Stroke and stops count from ``length``; with ``mid_stroke: riser in equilibrium`` from the length that is
    left above the riser when that stands plumb in still water under its tensioners, as spaced out.
    """

    length: Annotated[u.Length, POSITIVE]
    mid_stroke: Literal["riser in equilibrium"] | None = None
    bending_stiffness: Annotated[u.BendingStiffness, POSITIVE]
    tension: Annotated[u.Force, POSITIVE] | None = None
    stop: JointStop | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.stop and self.stop.collapse and self.stop.collapse >= self.length:
            raise ValueError(
                f"stop.collapse {self.stop.collapse:g} m: must be less than the joint's length, "
                f"{self.length:g} m"
            )
        return self

    @property
    def reach(self) -> tuple[float, float]:
        """Shortest and longest length before a stop touches (m); 0 and infinite without one."""
        stop = self.stop
        shortest = self.length - stop.collapse if stop and stop.collapse else 0.0
        return shortest, self.length + stop.stroke if stop and stop.stroke else math.inf


class TensionLoss(Strict):
    """A share of the top tension that is lost at a time, smoothly within another. Absent over: at once."""

    share: Annotated[float, Field(gt=0.0, le=1.0)]
    at: Annotated[u.Time, NOT_NEGATIVE]
    over: Annotated[u.Time, POSITIVE] | None = None


class Top(Strict):
    """Upper end. ``x`` (with y) and ``z`` follow the platform, are held at rest, or are free.

    ``x: vessel``: the top moves with a vessel that is free to, as far as its freedoms go. An offset is one
    of what the top hangs from, too: the deck of tensioners lies straight above the top. With a platform
    beside the vessel the top has its first-order motions as well, in z where ``z: platform``.

    Absent offset, elevation: straight above the bottom, where statics puts it. Absent tension, its loss,
    force, tensioners, body: none. ``held_at_tension``: z is held where the riser has this top tension at
    rest. With a telescopic joint the top is the joint's, and tension, tensioners, lateral force and body
    are at the tension ring below it.
    """

    x: Literal["platform", "held", "free", "vessel"] | None = None
    z: Literal["platform", "held", "free"]
    offset: u.Length | None = None
    elevation: u.Length | None = None
    held_at_tension: Annotated[u.Force, POSITIVE] | None = None
    tension: Annotated[u.Force, POSITIVE] | None = None
    tension_loss: TensionLoss | None = None
    lateral_force: u.Force | None = None
    rotation: Rotation | None = None
    body: Body | None = None
    tensioners: Tensioners | None = None
    telescopic_joint: TelescopicJoint | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.body and self.body.centre_below:
            raise ValueError("body.centre_below is for a free lower end")
        if self.elevation is not None and self.held_at_tension is not None:
            raise ValueError("give elevation or held_at_tension, not both")
        if self.z == "free" and (self.elevation is not None or self.held_at_tension is not None):
            raise ValueError(
                "elevation and held_at_tension need a z that is held or on the platform"
            )
        if self.tension_loss and self.tension is None:
            raise ValueError("tension_loss needs tension")
        pulled = self.tension is not None or self.tensioners is not None
        if self.telescopic_joint:
            if self.z == "free" or self.x == "free" or self.elevation is None:
                raise ValueError(
                    "above a telescopic_joint x and z are held or on the platform, at an elevation"
                )
            if not pulled and self.telescopic_joint.tension is None:
                raise ValueError(
                    "a telescopic_joint carries no tension: needs tension or tensioners"
                )
        elif self.z != "free" and pulled:
            raise ValueError("tension and tensioners need 'z: free', or a telescopic_joint")
        elif self.x != "free" and self.lateral_force is not None:
            raise ValueError("lateral_force needs 'x: free', or a telescopic_joint")
        place = self.tensioners and self.tensioners.arrangement
        if place and place.ring_radius > 0.0 and not self.telescopic_joint:
            raise ValueError(
                "ring_radius above 0 needs a telescopic_joint to take the ring's moment"
            )
        return self
