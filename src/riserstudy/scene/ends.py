"""The riser's ends: their supports, and the bodies attached to them."""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE
from riserstudy.scene.tensioners import Tensioners


class Areas(Strict):
    """Drag areas of a body: drag coefficient times area.

    Without the key ``horizontal`` or ``vertical``, the drag of the body in the missing direction is zero.
    """

    horizontal: Annotated[u.Area, NOT_NEGATIVE] | None = None
    vertical: Annotated[u.Area, NOT_NEGATIVE] | None = None


class BodyAddedMass(Strict):
    """Added mass of a body.

    Without the key ``horizontal`` or ``vertical``, the added mass in the missing direction is zero.
    """

    horizontal: Annotated[u.Mass, NOT_NEGATIVE] | None = None
    vertical: Annotated[u.Mass, NOT_NEGATIVE] | None = None


class Body(Strict):
    """A concentrated mass, such as a lower marine riser package (LMRP) or a tension ring.

    Give the submerged weight of the body, or give its displaced volume or the density of its material. From
    the volume or the density of the body, the engine computes its submerged weight with the mass and gravity.
    If the end of the unstretched riser with the body is at or above the water surface, the computed weight of
    the body is its weight in air. The weight, the drag and the added mass of a body are zero if they are not
    given. In waves, the accelerating water exerts a force on the body, in proportion to the sum of the mass
    of displaced water and the added mass. If the displaced volume of the body is not given, the engine
    computes the volume from the mass and the ``submerged_weight`` of the body. Without ``centre_below``, the
    body is a point at the riser's end. The key ``centre_below`` is the distance from the riser's lower end
    down to the centre of the body. With ``centre_below``, the body turns rigidly with the riser's lower end.
    The key ``rotary_inertia``, by default zero, is the moment of inertia about axes through the body's centre
    that are perpendicular to the riser. With ``centre_below``, the engine represents the body by two point
    masses: one at the riser's lower end, and one below the riser, at the body's centre of percussion. With
    ``centre_below``, the arclengths in results start at the body's centre of percussion. The arclengths of
    ``stations`` in ``analysis.output`` still start at the riser's lower end.
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
            raise Misfit(
                "", "several of submerged_weight, displaced_volume and density are given", "give only one"
            )
        if self.rotary_inertia is not None and self.centre_below is None:
            raise Misfit("", "rotary_inertia requires centre_below", "add it")
        if self.centre_below is not None and not self.horizontal_mass:
            raise Misfit(
                "", "centre_below requires a body with mass", "give mass or added_mass.horizontal above 0"
            )
        return self

    @property
    def horizontal_mass(self) -> float:
        """Mass with added mass (kg)."""
        return self.mass + ((self.added_mass and self.added_mass.horizontal) or 0.0)

    @property
    def reach(self) -> float:
        """Distance from the riser's end to the body's centre of percussion (m), 0 for a point.

        Two point masses, one at the end and one at the centre of percussion, with the body's mass and centre
        of mass have the body's rotary inertia, too.
        """
        if self.centre_below is None:
            return 0.0
        return self.centre_below + (self.rotary_inertia or 0.0) / (self.horizontal_mass * self.centre_below)

    @property
    def weightless(self) -> bool:
        """Whether the scene gives nothing that its weight follows from."""
        return self.submerged_weight is None and self.displaced_volume is self.density is None

    def weight(self, gravity: float, water: float) -> float:
        """Submerged weight (N); ``gravity`` in m/s2, density of the ``water`` in kg/m3."""
        if self._volume is None:
            return self.submerged_weight or 0.0
        return (self.mass - water * self._volume) * gravity

    def displaced(self, gravity: float, water: float) -> float:
        """Mass of the displaced water (kg); ``gravity`` in m/s2, density of the ``water`` in kg/m3."""
        if self._volume is not None:
            return water * self._volume
        if self.submerged_weight is None or not gravity:
            return 0.0
        return max(self.mass - self.submerged_weight / gravity, 0.0)

    @property
    def _volume(self) -> float | None:
        """Displaced volume (m3), None if only its weight is known."""
        return self.mass / self.density if self.density else self.displaced_volume


class FlexJoint(Strict):
    """Rotational spring between the riser and its support."""

    stiffness: Annotated[u.RotationalStiffness, NOT_NEGATIVE]


Rotation = Literal["free", "fixed"] | FlexJoint


class Bottom(Strict):
    """Lower end of the riser: held at the wellhead, free, or the lower end of a conductor (``foot``).

    A conductor is the pipe in the soil below the wellhead. The lower end of a conductor cannot move
    vertically; the soil resists the lateral motion of the conductor.
    """

    hold: Literal["wellhead", "free", "foot"]
    elevation: u.Length | None = None
    rotation: Rotation | None = None
    body: Body | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.hold != "free" and self.elevation is None:
            raise Misfit("", f"'hold: {self.hold}' requires an elevation", "add it")
        if self.hold == "free" and (self.elevation is not None or self.rotation is not None):
            raise Misfit("", "a free lower end has neither elevation nor rotation", "remove them")
        if self.hold != "free" and self.body and self.body.centre_below:
            raise Misfit(
                "", "body.centre_below is only for a free lower end", "write 'hold: free' or remove it"
            )
        return self


class JointStop(Strict):
    """Stops of a telescopic joint: its largest extension and compression, and the stiffness of the stops.

    The extension and the compression of the telescopic joint are measured from the position in which the
    stroke of the joint is zero. The key ``stroke`` is the largest extension of the telescopic joint. The key
    ``collapse`` is the largest compression, at which the two barrels touch and push against each other. The
    telescopic joint has a stop in extension only with the key ``stroke``, and a stop in compression only with
    the key ``collapse``. The stops of the joint are elastic, without energy loss.
    """

    stroke: Annotated[u.Length, POSITIVE] | None = None
    collapse: Annotated[u.Length, POSITIVE] | None = None
    stiffness: Annotated[u.Stiffness, POSITIVE]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.stroke is None and self.collapse is None:
            raise Misfit(
                "",
                "neither stroke nor collapse is given",
                "give stroke (outwards), collapse (inwards) or both",
            )
        return self


class TelescopicJoint(Strict):
    """Telescopic joint above the tension ring: it slides without resistance, and carries shear and bending.

    The engine neglects forces of the water on the telescopic joint. A warning appears if more than half of
    the telescopic joint is below the water surface. The key ``length`` is the distance from the tension ring
    to the upper end of the telescopic joint with the platform at rest. Both barrels of the joint bend
    together, as one beam. The key ``tension`` is an additional constant pull of tensioners along the joint.
    Without the key ``stop``, the telescopic joint has no end stops. Without stops, a warning appears if the
    telescopic joint becomes shorter than half of ``length`` or longer than twice ``length``. Include the mass
    of the outer barrel in ``top.body`` at the tension ring; the inner barrel moves with the platform. The
    stops of the joint (``stop``) and the stops of the tensioners (``tensioners.stroke``) are separate, and a
    scene can have both.

    By default, the stroke of the telescopic joint and the positions of its stops are measured from
    ``length``. With ``mid_stroke: riser in equilibrium``, the stroke of the telescopic joint is zero when the
    tensioners carry the vertical riser in still water.
    """

    length: Annotated[u.Length, POSITIVE]
    mid_stroke: Literal["riser in equilibrium"] | None = None
    bending_stiffness: Annotated[u.BendingStiffness, POSITIVE]
    tension: Annotated[u.Force, POSITIVE] | None = None
    stop: JointStop | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.stop and self.stop.collapse and self.stop.collapse >= self.length:
            raise Misfit(
                "",
                f"stop.collapse {self.stop.collapse:g} m is not less than the length of the joint",
                f"give less than {self.length:g} m",
            )
        return self

    @property
    def reach(self) -> tuple[float, float]:
        """Shortest and longest length before a stop touches (m); 0 and infinite without one."""
        stop = self.stop
        shortest = self.length - stop.collapse if stop and stop.collapse else 0.0
        return shortest, self.length + stop.stroke if stop and stop.stroke else math.inf


class TensionLoss(Strict):
    """Loss of a share of ``top.tension`` at the time ``at``: suddenly, or smoothly over the time ``over``.

    A loss of ``top.tension`` does not change the forces of ``tensioners`` and of a telescopic joint.
    """

    share: Annotated[float, Field(gt=0.0, le=1.0)]
    at: Annotated[u.Time, NOT_NEGATIVE]
    over: Annotated[u.Time, POSITIVE] | None = None


class Top(Strict):
    """Upper end of the riser.

    The keys ``x`` (for x and y) and ``z`` state whether the riser's top follows the platform, is held, or is
    free.

    With ``x: vessel``, the riser's top follows the computed motion of a vessel along x, and along y if the
    vessel has the key ``sway``. If the scene also has the key ``platform``, the engine adds the horizontal
    first-order (wave-frequency) motions of the platform to the motion of the vessel. With ``z: platform``,
    the riser's top also follows the vertical first-order motions of the platform. At rest, the centre of the
    tensioner deck is vertically above the riser's top, so the key ``offset`` moves both the deck and the top.

    Without ``offset``, the riser's top is vertically above the riser's bottom. Without ``elevation``, the
    engine computes the height of the riser's top in static equilibrium. A tension, a tension loss, a lateral
    force, tensioners and a body are absent at the riser's top if they are not given. With
    ``held_at_tension``, the engine holds the riser's top at the height at which the vertical component of the
    pull on the static riser equals the given force. If there is a body at the top, the pull just below the
    body equals the given force of ``held_at_tension``. The height for ``held_at_tension`` is computed with
    the platform in its position in calm water, and with the current at its full speed. With ``x: platform``,
    or with ``x: vessel`` and a ``platform`` in the scene, a flex joint or clamp (``rotation: fixed``) at the
    top rotates with the platform. With a telescopic joint, the riser's top is the upper end of this joint,
    and ``tension``, ``tensioners``, ``lateral_force`` and ``body`` are at the tension ring, below the joint.
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
            raise Misfit("", "body.centre_below is only for a body at a free lower end", "remove it")
        if self.elevation is not None and self.held_at_tension is not None:
            raise Misfit("", "elevation and held_at_tension are both given", "give only one")
        if self.z == "free" and (self.elevation is not None or self.held_at_tension is not None):
            raise Misfit(
                "",
                "elevation and held_at_tension do not apply to 'z: free'",
                "write 'z: held' or 'z: platform', or remove them",
            )
        if self.x == "free" and self.offset:
            raise Misfit(
                "",
                "offset does not apply to 'x: free'",
                "write 'x: held', 'x: platform' or 'x: vessel', or remove offset",
            )
        if self.tension_loss and self.tension is None:
            raise Misfit("", "tension_loss requires tension", "add it")
        pulled = self.tension is not None or self.tensioners is not None
        if self.telescopic_joint:
            if self.z == "free" or self.x == "free" or self.elevation is None:
                raise Misfit(
                    "",
                    "a telescopic_joint requires a held top with an elevation",
                    "give elevation, and write 'held' or 'platform' for x and z",
                )
            if not pulled and self.telescopic_joint.tension is None:
                raise Misfit(
                    "", "no tension holds the riser below the telescopic_joint", "give tension or tensioners"
                )
        elif self.z != "free" and pulled:
            raise Misfit(
                "",
                f"tension and tensioners have no effect with 'z: {self.z}'",
                "write 'z: free', or give a telescopic_joint",
            )
        elif self.x != "free" and self.lateral_force is not None:
            raise Misfit(
                "", "lateral_force has no effect on a held top", "write 'x: free', or give a telescopic_joint"
            )
        place = self.tensioners and self.tensioners.arrangement
        if place and place.ring_radius > 0.0 and not self.telescopic_joint:
            raise Misfit(
                "",
                "tensioners.arrangement.ring_radius above 0 requires a telescopic_joint, which carries the "
                "moment of the ring",
                "add it, or give a ring_radius of 0 m",
            )
        return self
