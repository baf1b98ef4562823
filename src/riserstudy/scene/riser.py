"""The riser string: sections from the bottom up, with contents, drag, added mass and vortices."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import Field, PrivateAttr, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE, WHOLE, Coefficient
from riserstudy.scene.damping import DampingAtPeriod
from riserstudy.scene.modules_and_lines import Line, Modules, check_wall, disc

RIGID = 1e3  # ratio of the bending stiffness of a rigid body to that of the section above it


class CoefficientAt(Strict):
    """A drag coefficient at an elevation.

    In a table of drag coefficients, two entries at one elevation define a jump of the coefficient.
    """

    elevation: u.Length
    value: Coefficient


class Drag(Strict):
    """Drag of the riser by Morison's equation, by default across the pipe.

    With ``direction: horizontal``, only horizontal velocities cause drag, and the drag acts in x and y only.
    The drag coefficient is one number, or a table over elevation with linear interpolation. The engine
    evaluates the table of drag coefficients at the present elevation of the moving, stretched pipe. Outside
    the elevations of a table of drag coefficients, the coefficient has the value at the nearest end.
    """

    coefficient: Coefficient | Annotated[list[CoefficientAt], Field(min_length=2)]
    diameter: Annotated[u.Length, POSITIVE]
    direction: Literal["horizontal"] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if any(a > b for (a, _), (b, _) in pairwise(self.table)):
            raise Misfit(
                "coefficient",
                "the elevations decrease from point to point",
                "order the points from the lowest elevation to the highest",
            )
        if any(a == c for (a, _), (c, _) in zip(self.table, self.table[2:], strict=False)):
            found = "three points have one elevation"
            remedy = "give at most two points (a jump) at one elevation"
            raise Misfit("coefficient", found, remedy)
        return self

    @property
    def table(self) -> tuple[tuple[float, float], ...]:
        """Elevations (m) and coefficients (1); empty for a constant coefficient."""
        points = self.coefficient if isinstance(self.coefficient, list) else []
        return tuple((point.elevation, point.value) for point in points)

    @property
    def constant(self) -> float:
        """The coefficient (1), if it is constant."""
        if isinstance(self.coefficient, list):
            raise TypeError("a drag coefficient over elevation where one number is needed")
        return self.coefficient


class TangentialDrag(Strict):
    """Drag along the pipe: C_t rho pi D / 2 times the squared relative velocity along the pipe.

    In the formula of the tangential drag, C_t is the key ``coefficient``, rho the density of the water, and D
    the key ``diameter``.
    """

    coefficient: Coefficient
    diameter: Annotated[u.Length, POSITIVE]


class AddedMass(Strict):
    """Added mass per length of riser, C_a rho pi D^2 / 4, by default for motion across the pipe.

    In the formula of the added mass, C_a is the key ``coefficient``, rho the density of the water, and D the
    key ``diameter``. With ``direction: horizontal``, the added mass acts in x and y only.
    """

    coefficient: Coefficient
    diameter: Annotated[u.Length, POSITIVE]
    direction: Literal["horizontal"] | None = None

    def displaced(self, density: float) -> float:
        """Mass of the displaced water (kg/m)."""
        return density * disc(self.diameter)


def _must_rise(frequencies: list[float]) -> None:
    if any(a >= b for a, b in pairwise(frequencies)):
        raise Misfit(
            "frequencies", f"{frequencies} do not increase", "order them from the lowest to the highest"
        )


class InLineExcitation(Strict):
    """Varying drag due to vortices, which synchronises with the velocity of the riser along the flow.

    The amplitude of the varying drag per length is C_x rho D / 2 times the squared flow speed. In the formula
    of the varying drag, C_x is the key ``coefficient``, rho the density of the water, and D the diameter. The
    coefficient of the varying drag is unknown; values of 0.1 to 1 are plausible. The key ``frequencies``
    lists the lowest, the in-phase and the highest frequency of the varying drag, as multiples of flow speed
    divided by diameter. Frequencies along the flow are about twice the frequencies across the flow. For the
    varying drag, ``frequencies`` of 0.22, 0.36 and 0.52 are assumptions, each ±25 %.
    """

    coefficient: Annotated[float, POSITIVE]
    frequencies: Annotated[list[Annotated[float, POSITIVE]], Field(min_length=3, max_length=3)]

    @model_validator(mode="after")
    def _rising(self) -> Self:
        _must_rise(self.frequencies)
        return self


class VortexInducedVibration(Strict):
    """Vortex-induced vibration across the flow, by the synchronisation model of Thorsen and others (2014).

    The vortices exert a lift force on the pipe, across the flow (the velocity of the water relative to the
    pipe). The amplitude of the lift force per length is C_v rho D U^2 / 2, with the flow speed U, the density
    rho of the water, and the diameter D. The phase of the lift force synchronises with the velocity of the
    riser. A section with ``viv`` must also have drag across the pipe, because drag limits the amplitude of
    the vibration. The engine simulates a scene with ``viv`` in three dimensions.

    The key ``coefficient`` is C_v of the lift force; its published value is 1.2. The key ``frequencies``
    lists the lowest, the in-phase and the highest frequency of the lift force, as multiples of flow speed
    divided by diameter. At the in-phase frequency, lift force and riser velocity are in phase. The published
    ``frequencies`` of the lift force are 0.11, 0.18 and 0.26. The engine computes running mean squares of the
    motion, over the time in which the water flows a distance of ``memory`` diameters, for example 20. The key
    ``seed`` determines the initial phases of the lift force, which vary smoothly along the riser. The key
    ``ramp`` is the time over which the lift force increases from zero to its full amplitude. The default of
    ``ramp`` is ten periods of vortex shedding in the fastest current. The key ``in_line`` adds an excitation
    along the flow; without ``in_line``, vortices cause no excitation along the flow.
    """

    model: Literal["synchronisation"]
    diameter: Annotated[u.Length, POSITIVE]
    coefficient: Annotated[float, POSITIVE]
    frequencies: Annotated[list[Annotated[float, POSITIVE]], Field(min_length=3, max_length=3)]
    memory: Annotated[float, POSITIVE]
    seed: Annotated[int, Field(ge=0), WHOLE]
    ramp: Annotated[u.Time, POSITIVE] | None = None
    in_line: InLineExcitation | None = None

    @property
    def highest_frequency(self) -> float:
        """Highest frequency of lift and in-line excitation, as a multiple of speed / diameter (1)."""
        return max(self.frequencies[2], self.in_line.frequencies[2] if self.in_line else 0.0)

    @model_validator(mode="after")
    def _rising(self) -> Self:
        _must_rise(self.frequencies)
        return self


class Contents(Strict):
    """Fluid inside the riser. The engine adds the weight of the riser's contents to ``submerged_weight``.

    If the pipe moves across its axis, the contents move with the pipe. If the pipe moves along its axis, the
    contents do not move with the pipe. If the inside of the riser is open to the sea, give sea water as
    contents, or include the weight of sea water inside the riser in ``submerged_weight``. The contents reach
    up to the elevation ``level``, by default to the upper end of the highest section with contents. The gauge
    pressure of the contents on the wall is the static pressure of the column of contents up to ``level``. If
    a section without contents lies between sections with contents, the pressure in the sections below the gap
    is unknown. For sections with unknown pressure, the von Mises stress is not computed.
    """

    density: Annotated[u.Density, POSITIVE]
    level: u.Length | None = None


class Joints(Strict):
    """Number of equal riser joints, and the length of one joint."""

    count: Annotated[int, Field(ge=1), WHOLE]
    length: Annotated[u.Length, POSITIVE]


class StructuralDamping(DampingAtPeriod):
    """Damping of the pipe, proportional to its stiffness.

    The key ``ratio`` is the ratio of damping to critical damping for a vibration with the period
    ``at_period``. Flex joints are not damped: the moment of a flex joint is stiffness times angle.
    """


class InnerJoint(Strict):
    """Rotational spring (flex joint) between a riser section and the section below it."""

    stiffness: Annotated[u.RotationalStiffness, POSITIVE]


class Guide(Strict):
    """Spring between the lower end of a riser section and the vertical axis of the well.

    The stiffness of the spring towards the well axis is the same in all horizontal directions.
    """

    stiffness: Annotated[u.Stiffness, POSITIVE]


class Section(Strict):
    """A length of riser with uniform properties. The sections of a riser are listed from the bottom up.

    Give the axial and the bending stiffness, or give Young's modulus and the diameters, from which the engine
    computes the axial and the bending stiffness. A section without bending stiffness is a string: it carries
    no bending moment. Give ``mass``, or ``wall_density``, from which the engine computes the mass. Without
    ``mass`` and ``wall_density``, the mass of a section is zero. If at least one section has a shear modulus,
    the torsion of the riser resists the yaw of a vessel, and sections without a shear modulus are rigid in
    torsion. Other section properties that are not given, such as drag, are zero.

    The key ``submerged_weight`` is the weight of the pipe with everything fixed to it, minus the weight of
    the water that the *outer* surface displaces. The key ``submerged_weight`` does not include the weight of
    ``contents``. An example of a submerged weight is a bare steel pipe with an outer diameter of 21 in, an
    inner diameter of 19 in and a mass of 318.2 kg/m. The example pipe has a submerged weight of 874.7 N/m in
    sea water of 1025 kg/m^3, with a gravity of 9.81 m/s^2. If the example pipe is full of mud of 1200 kg/m^3,
    the key ``contents`` adds 2153.4 N/m. If the example pipe is full of sea water, give a
    ``submerged_weight`` of 874.7 N/m with ``contents`` of 1025 kg/m^3. Without ``contents``, the pipe full of
    sea water has a ``submerged_weight`` of 2714.1 N/m, including 1839.4 N/m of water inside the pipe. If a
    section has no ``submerged_weight``, the engine computes the submerged weight from mass, diameters,
    gravity and water density. A section without ``submerged_weight`` must therefore have an inner diameter
    and ``contents``; otherwise the engine refuses the scene. For a section wholly above the water,
    ``submerged_weight`` is the weight in air. If a section crosses the water surface, and has no
    ``submerged_weight``, or has ``modules`` or ``lines``, the engine divides the section at the surface. In
    results, the part above the water is named ``<name>, above water``. If a divided section has a given
    ``submerged_weight``, the engine adds the missing buoyancy to the weight of the part above the water. The
    missing buoyancy is the weight of water in the volume of the outer diameter.

    The key ``buoyancy_lift``, the net lift of buoyancy modules in water, has no effect on the simulation,
    because ``submerged_weight`` already includes the lift. Only the minimum tension formula of the command
    ``riserstudy tension`` requires ``buoyancy_lift``, because the formula treats steel and modules
    separately. Without ``buoyancy_lift``, ``riserstudy tension`` omits the minimum tension formula.

    If a section has ``modules`` or ``lines``, the given mass, weight and stiffness refer to the pipe alone.
    The engine adds the mass, weight and stiffness of modules and lines to the values of the pipe. If a scene
    has ``modules``, the engine computes ``buoyancy_lift`` from the lift of the modules; in sections without
    modules, ``buoyancy_lift`` is zero. The diameters in the keys ``drag`` and ``added_mass`` of a section
    apply to pipe, modules and lines together.
    """

    name: str
    length: Annotated[u.Length, POSITIVE] | None = None
    joints: Joints | None = None
    outer_diameter: Annotated[u.Length, POSITIVE] | None = None
    inner_diameter: Annotated[u.Length, NOT_NEGATIVE] | None = None
    young_modulus: Annotated[u.Modulus, POSITIVE] | None = None
    shear_modulus: Annotated[u.Modulus, POSITIVE] | None = None
    axial_stiffness: Annotated[u.Force, POSITIVE] | None = None
    bending_stiffness: Annotated[u.BendingStiffness, POSITIVE] | None = None
    mass: Annotated[u.MassPerLength, POSITIVE] | None = None
    wall_density: Annotated[u.Density, POSITIVE] | None = None
    submerged_weight: u.ForcePerLength | None = None
    buoyancy_lift: Annotated[u.ForcePerLength, NOT_NEGATIVE] | None = None
    modules: Modules | None = None
    lines: Annotated[list[Line], Field(min_length=1)] | None = None
    lateral_load: u.ForcePerLength | None = None
    drag: Drag | None = None
    tangential_drag: TangentialDrag | None = None
    added_mass: AddedMass | None = None
    viv: VortexInducedVibration | None = None
    contents: Contents | None = None
    structural_damping: StructuralDamping | None = None
    flex_joint_below: InnerJoint | None = None
    guide_below: Guide | None = None
    _line: str = PrivateAttr("")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.length is None) == (self.joints is None):
            raise Misfit("", "length or joints is required, not both", "give one of them")
        outer, inner = self.outer_diameter, self.inner_diameter
        if inner is not None and outer is None:
            raise Misfit("", "inner_diameter is given without outer_diameter", "add outer_diameter")
        if inner is not None and outer is not None:
            check_wall(outer, inner)
        if self.wall_density and (self.mass or self.inner_diameter is None):
            raise Misfit(
                "",
                "wall_density gives the mass from the diameters",
                "add outer_diameter and inner_diameter, and remove mass",
            )
        tube = self.young_modulus is not None
        if tube and (self.outer_diameter is None or self.inner_diameter is None):
            raise Misfit("", "young_modulus requires the diameters", "add outer_diameter and inner_diameter")
        if self.shear_modulus and self.inner_diameter is None:
            raise Misfit("", "shear_modulus requires the diameters", "add outer_diameter and inner_diameter")
        if tube and (self.axial_stiffness or self.bending_stiffness):
            raise Misfit(
                "",
                "young_modulus is given together with axial_stiffness or bending_stiffness",
                "give young_modulus, or the stiffnesses, not both",
            )
        if not tube and self.axial_stiffness is None:
            raise Misfit(
                "", "the axial stiffness is missing", "give young_modulus with diameters, or axial_stiffness"
            )
        if self.contents and self.inner_diameter is None:
            raise Misfit("", "contents require inner_diameter", "add it")
        if (self.modules or self.lines) and not (self.mass or self.wall_density):
            raise Misfit("", "modules and lines require the mass of the pipe", "add mass or wall_density")
        if self.modules and self.buoyancy_lift is not None:
            raise Misfit("", "modules and buoyancy_lift both give lift", "give only one of them")
        if len({line.name for line in self.lines or []}) < len(self.lines or []):
            raise Misfit("lines", "two lines have the same name", "give each line a different name")
        if self.wall_density:
            return self.replaced(mass=self.wall_density * self.wall_area)
        return self

    @property
    def wall_area(self) -> float:
        """Cross section of the wall (m2)."""
        outer, inner = self.outer_diameter or 0.0, self.inner_diameter or 0.0
        return 0.25 * math.pi * (outer**2 - inner**2)

    @property
    def twist(self) -> float:
        """Angle of twist divided by torque, L / (G I_p) (rad/(N m)); 0 without a shear modulus."""
        outer, inner = self.outer_diameter or 0.0, self.inner_diameter or 0.0
        polar = math.pi / 32.0 * (outer**4 - inner**4)
        return self.total_length / (self.shear_modulus * polar) if self.shear_modulus else 0.0

    @property
    def elasticity(self) -> tuple[float, float]:
        """EA (N) and EI (N m2) of pipe and lines; EI is 0 for a string."""
        axial, bending = self.pipe_elasticity
        more = [line.elasticity for line in self.lines or []]
        axial += sum(a for a, _ in more)
        return axial, bending + sum(b for _, b in more) if bending else 0.0

    @property
    def pipe_shares(self) -> tuple[float, float]:
        """Shares of tension and bending moment that the pipe carries; the lines carry the rest."""
        if not self.lines:
            return 1.0, 1.0
        own, whole = self.pipe_elasticity, self.elasticity
        return own[0] / whole[0], own[1] / whole[1] if whole[1] else 1.0

    @property
    def pipe_elasticity(self) -> tuple[float, float]:
        """EA (N) and EI (N m2) of the pipe alone; EI is 0 for a string."""
        if self.young_modulus is None:
            return self.axial_stiffness or 0.0, self.bending_stiffness or 0.0
        outer, inner = self.outer_diameter or 0.0, self.inner_diameter or 0.0
        second = math.pi / 64.0 * (outer**4 - inner**4)
        return self.young_modulus * self.wall_area, self.young_modulus * second

    def rigid(self, name: str, length: float) -> RigidBody:
        """A weightless, nearly rigid section of a length (m), with the axial stiffness of this section."""
        axial, bending = self.elasticity
        body = RigidBody.model_construct(
            name=name,
            length=length,
            axial_stiffness=axial,
            bending_stiffness=RIGID * bending or None,
            structural_damping=self.structural_damping,
        )
        body.stands_at("bottom.body")
        return body

    @property
    def line(self) -> str:
        """Path, in the scene's file, of the part that it represents; "" outside of a scene."""
        return self._line

    def stands_at(self, line: str) -> None:
        """Store its path in the scene's file; sections that are divided from it keep this path."""
        self._line = line

    @property
    def corner_below(self) -> bool:
        """Whether the shear jumps at the section's lower end, due to a flex joint or guide."""
        return bool(self.flex_joint_below or self.guide_below)

    @property
    def contents_mass(self) -> float:
        """Mass of the fluid inside (kg/m)."""
        bore = disc(self.inner_diameter or 0.0)
        return self.contents.density * bore if self.contents else 0.0

    @property
    def total_length(self) -> float:
        """Unstretched length (m)."""
        if self.joints is not None:
            return self.joints.count * self.joints.length
        return self.length or 0.0


class RigidBody(Section):
    """A section below the riser that represents a body which turns with the riser's end."""
