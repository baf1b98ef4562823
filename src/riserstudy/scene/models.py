"""What a scene may say. Every section is present or absent; what is absent is not simulated.

Fields hold SI once read. No field has a default that changes physics: an absent section stands for an
absent effect, and its docstring says so.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Generic, Literal, Self, TypeVar

from pydantic import BaseModel, ConfigDict, Field, model_validator

from riserstudy.scene import units as u


class Strict(BaseModel):
    """Refuses unknown keys, NaN and conversions."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)


POSITIVE, NOT_NEGATIVE = Field(gt=0), Field(ge=0)
Positive = Annotated[float, POSITIVE]
Coefficient = Annotated[float, NOT_NEGATIVE]


class Water(Strict):
    """The sea. Absent: vacuum, no drag, no added mass, no current."""

    density: Annotated[u.Density, POSITIVE]


class Drag(Strict):
    """Morison drag across the pipe."""

    coefficient: Coefficient
    diameter: Annotated[u.Length, POSITIVE]


class AddedMass(Strict):
    """Added mass across the pipe, C_a rho pi D^2 / 4."""

    coefficient: Coefficient
    diameter: Annotated[u.Length, POSITIVE]


class Contents(Strict):
    """Fluid inside: adds weight, and mass across the pipe."""

    density: Annotated[u.Density, POSITIVE]


class Joints(Strict):
    """Number and length of equal joints."""

    count: Annotated[int, Field(ge=1)]
    length: Annotated[u.Length, POSITIVE]


class StructuralDamping(Strict):
    """Damping in proportion to stiffness: ratio of critical at one period."""

    ratio: Annotated[float, NOT_NEGATIVE]
    at_period: Annotated[u.Time, POSITIVE]


class Section(Strict):
    """A length of riser with uniform properties, from the bottom up.

    Stiffness comes from modulus and diameters, or is given; without bending stiffness the section is a
    string. Absent mass, weight, drag, added mass, contents, damping or load: none.
    """

    name: str
    length: Annotated[u.Length, POSITIVE] | None = None
    joints: Joints | None = None
    outer_diameter: Annotated[u.Length, POSITIVE] | None = None
    inner_diameter: Annotated[u.Length, NOT_NEGATIVE] | None = None
    young_modulus: Annotated[u.Modulus, POSITIVE] | None = None
    axial_stiffness: Annotated[u.Force, POSITIVE] | None = None
    bending_stiffness: Annotated[u.BendingStiffness, POSITIVE] | None = None
    mass: Annotated[u.MassPerLength, POSITIVE] | None = None
    submerged_weight: u.ForcePerLength | None = None
    lateral_load: u.ForcePerLength | None = None
    drag: Drag | None = None
    added_mass: AddedMass | None = None
    contents: Contents | None = None
    structural_damping: StructuralDamping | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.length is None) == (self.joints is None):
            raise ValueError("needs one of length and joints")
        outer, inner = self.outer_diameter, self.inner_diameter
        if inner is not None and outer is None:
            raise ValueError("inner_diameter needs outer_diameter")
        if inner is not None and outer is not None and inner >= outer:
            raise ValueError(
                f"inner_diameter {self.inner_diameter:g} m must be smaller than "
                f"outer_diameter {self.outer_diameter:g} m"
            )
        tube = self.young_modulus is not None
        if tube and (self.outer_diameter is None or self.inner_diameter is None):
            raise ValueError("young_modulus needs outer_diameter and inner_diameter")
        if tube and (self.axial_stiffness or self.bending_stiffness):
            raise ValueError("give young_modulus, or the stiffnesses, not both")
        if not tube and self.axial_stiffness is None:
            raise ValueError("needs young_modulus with diameters, or axial_stiffness")
        if self.contents and self.inner_diameter is None:
            raise ValueError("contents need inner_diameter")
        return self

    @property
    def total_length(self) -> float:
        """Unstretched length (m)."""
        if self.joints is not None:
            return self.joints.count * self.joints.length
        return self.length or 0.0


class Areas(Strict):
    """Drag areas C_D A of a body. An absent direction has no drag."""

    horizontal: Annotated[u.Area, NOT_NEGATIVE] | None = None
    vertical: Annotated[u.Area, NOT_NEGATIVE] | None = None


class BodyAddedMass(Strict):
    """Added mass of a body. An absent direction has none."""

    horizontal: Annotated[u.Mass, NOT_NEGATIVE] | None = None
    vertical: Annotated[u.Mass, NOT_NEGATIVE] | None = None


class Body(Strict):
    """A concentrated mass: LMRP, tension ring. Absent weight, drag, added mass: none."""

    name: str
    mass: Annotated[u.Mass, NOT_NEGATIVE]
    submerged_weight: u.Force | None = None
    drag_area: Areas | None = None
    added_mass: BodyAddedMass | None = None


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


class Gas(Strict):
    """One gas chamber a cylinder at mid-stroke; F = A P (V / (V - A reach))^k."""

    area: Annotated[u.Area, POSITIVE]
    pressure: Annotated[u.Pressure, POSITIVE]
    volume: Annotated[u.Volume, POSITIVE]
    exponent: Annotated[float, Field(gt=1)]


class Linear(Strict):
    """Straight line a cylinder: tension at mid-stroke and stiffness."""

    tension: Annotated[u.Force, POSITIVE]
    stiffness: Annotated[u.Stiffness, NOT_NEGATIVE]


class Linearised(Strict):
    """The gas law replaced by a straight line: its tangent, or least squares over a stroke range."""

    by: Literal["tangent", "least squares"]
    shortest: u.Length | None = None
    longest: u.Length | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        fitted = self.by == "least squares"
        if fitted != (self.shortest is not None) or fitted != (self.longest is not None):
            raise ValueError("least squares needs shortest and longest, a tangent neither")
        if self.shortest is not None and self.longest is not None and self.shortest >= self.longest:
            raise ValueError("shortest must be below longest")
        return self


class Stroke(Strict):
    """Reach at which the stops touch, from mid-stroke, + longer; and their stiffness."""

    shortest: u.Length
    longest: u.Length
    stop_stiffness: Annotated[u.Stiffness, POSITIVE]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if not self.shortest < 0 < self.longest:
            raise ValueError("shortest must be below zero and longest above")
        return self


class Tensioners(Strict):
    """Equal upright cylinders between ring and deck. Absent damping or stroke: none, no stops."""

    count: Annotated[int, Field(ge=1)]
    mid_stroke: Literal["riser unstretched", "riser in equilibrium"]
    gas: Gas | None = None
    linearised: Linearised | None = None
    linear: Linear | None = None
    damping: Annotated[u.Damping, NOT_NEGATIVE] | None = None
    stroke: Stroke | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.gas is None) == (self.linear is None):
            raise ValueError("needs one of gas and linear")
        if self.linearised and self.gas is None:
            raise ValueError("linearised needs gas")
        if self.gas:
            room = self.gas.volume / self.gas.area
            for what, limit in (("stroke", self.stroke), ("linearised", self.linearised)):
                longest = limit.longest if limit else None
                if longest is not None and longest >= room:
                    raise ValueError(
                        f"{what}.longest {longest:g} m closes the gas volume, "
                        f"which is empty at {room:g} m"
                    )
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


class Harmonic(Strict):
    """amplitude sin(2 pi t / period + phase), grown by a half cosine over the ramp. Absent: 0."""

    amplitude: float
    period: Annotated[u.Time, POSITIVE]
    phase: u.Angle | None = None
    ramp: Annotated[u.Time, POSITIVE] | None = None


class Translation(Harmonic):
    """Harmonic surge or heave."""

    amplitude: Annotated[u.Length, NOT_NEGATIVE]


class Tilt(Harmonic):
    """Harmonic pitch."""

    amplitude: Annotated[u.Angle, NOT_NEGATIVE]


class Cruise(Strict):
    """Constant speed along x, reached linearly over the ramp. Absent ramp: at once."""

    speed: u.Speed
    ramp: Annotated[u.Time, POSITIVE] | None = None


class Instant(Strict):
    """One point of a time series."""

    time: u.Time
    value: float


class Moved(Instant):
    """Surge or heave at a time."""

    value: u.Length


class Tilted(Instant):
    """Pitch at a time."""

    value: u.Angle


P = TypeVar("P", bound=Instant)


class TimeSeries(Strict, Generic[P]):
    """A motion by points, or by a CSV table ``{file: name.csv}``; a cubic spline joins them."""

    points: Annotated[list[P], Field(min_length=4)]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if any(a.time >= b.time for a, b in pairwise(self.points)):
            raise ValueError("points: times must rise from point to point")
        return self


class Position(Strict):
    """Where the platform rests, away from above the well. An absent direction: there."""

    surge: u.Length | None = None
    heave: u.Length | None = None


class Platform(Strict):
    """Prescribed motion. An absent motion is none."""

    position: Position | None = None
    surge: Translation | TimeSeries[Moved] | None = None
    heave: Translation | TimeSeries[Moved] | None = None
    pitch: Tilt | TimeSeries[Tilted] | None = None
    cruise: Cruise | None = None


class Point(Strict):
    """One point of a current profile."""

    elevation: u.Length
    speed: u.Speed


class Shape(Strict):
    """A named profile from the seabed to the surface: (height / depth)^power, or exp(-depth / scale)."""

    shape: Literal["uniform", "power", "exponential"]
    surface_speed: u.Speed
    seabed: u.Length
    surface: u.Length
    power: Positive | None = None
    scale: Annotated[u.Length, POSITIVE] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.seabed >= self.surface:
            raise ValueError("seabed must lie below surface")
        for name, needed in (("power", "power"), ("scale", "exponential")):
            if (getattr(self, name) is not None) != (self.shape == needed):
                raise ValueError(f"{name} belongs to shape {needed!r}, and only to it")
        return self


class Current(Strict):
    """Steady current along x. Absent ramp: it flows from the start."""

    profile: Annotated[list[Point], Field(min_length=2)] | Shape
    ramp: Annotated[u.Time, POSITIVE] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        points = self.profile if isinstance(self.profile, list) else []
        if any(a.elevation >= b.elevation for a, b in pairwise(points)):
            raise ValueError("profile: elevations must rise from point to point")
        return self


class Mesh(Strict):
    """Equal segments within each section, at least this many in all."""

    elements: Annotated[int, Field(ge=1, le=20000)]


class GeneralisedAlpha(Strict):
    """Implicit stepping with spectral radius rho_inf at high frequency."""

    rho_inf: Annotated[float, Field(ge=0, le=1)]


class Newmark(Strict):
    """Newmark's implicit stepping."""

    beta: Annotated[float, Field(ge=0.001, le=1)]
    gamma: Annotated[float, Field(ge=0, le=1)]


class Output(Strict):
    """Times and places of histories. Absent from: the start; absent stations: all nodes."""

    interval: Annotated[u.Time, POSITIVE]
    start: Annotated[u.Time, NOT_NEGATIVE] | None = None
    stations: list[u.Length] | None = None


class Analysis(Strict):
    """What is computed.

    Absent duration: statics only. Absent mesh, step: by accuracy (0.2 % of displacement, 1 % of moment
    where accuracy is absent too). Absent method: generalised-alpha, 0.8.
    """

    duration: Annotated[u.Time, POSITIVE] | None = None
    output: Output | None = None
    start: Literal["equilibrium", "unstretched"] | None = None
    mesh: Mesh | None = None
    step: Annotated[u.Time, POSITIVE] | None = None
    accuracy: Annotated[u.Percent, Field(gt=0, lt=1)] | None = None
    method: Literal["explicit"] | GeneralisedAlpha | Newmark | None = None
    newton_tolerance: Annotated[float, Field(gt=0, le=1e-3)] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.duration is None) != (self.output is None):
            raise ValueError(
                "duration and output go together: both for dynamics, neither for statics"
            )
        if self.accuracy is not None and (self.mesh or self.step):
            raise ValueError("give accuracy, or mesh and step, not both")
        if self.duration is not None and (self.mesh is None) != (self.step is None):
            raise ValueError("give mesh and step together, or neither")
        if self.duration is None and (self.step or self.method):
            raise ValueError("step and method need a duration")
        if self.method == "explicit" and self.mesh is None:
            raise ValueError("explicit stepping needs mesh and step")
        return self


class Scene(Strict):
    """A riser and what acts on it. ``paper`` makes plain values published; without it, given."""

    title: str
    paper: str | None = None
    note: str | None = None
    gravity: Annotated[u.Acceleration, POSITIVE] | None = None
    water: Water | None = None
    riser: Annotated[list[Section], Field(min_length=1)]
    bottom: Bottom
    top: Top
    platform: Platform | None = None
    current: Current | None = None
    analysis: Analysis

    @model_validator(mode="after")
    def _fits(self) -> Self:
        wet = [s for s in self.riser if s.drag or s.added_mass]
        if wet and self.water is None:
            raise ValueError(f"riser section {wet[0].name!r} has drag or added mass: needs water")
        if self.current and self.water is None:
            raise ValueError("current needs water")
        if self.current and not any(s.drag for s in self.riser):
            raise ValueError("current needs a riser section with drag")
        if any(s.contents for s in self.riser) and self.gravity is None:
            raise ValueError("contents need gravity")
        if self.bottom.hold == "free" and self.top.z == "free":
            raise ValueError("both ends are free: hold one")
        if self.analysis.duration and not (
            all(s.mass for s in self.riser) or self.top.body or self.bottom.body
        ):
            raise ValueError("dynamics need mass: give every section its mass, or an end a body")
        if self.lateral and self.top.x is None:
            raise ValueError(f"top.x is needed, because of {self.lateral}")
        bending = [bool(s.young_modulus or s.bending_stiffness) for s in self.riser]
        if any(bending) and not all(bending):
            raise ValueError("riser: give bending stiffness to all sections or to none")
        if len({s.structural_damping for s in self.riser}) > 1:
            raise ValueError("riser: structural_damping must be the same in all sections")
        if self.top.z != "free" and self.bottom.hold == "free" and self.top.elevation is None:
            raise ValueError("a riser that hangs needs top.elevation")
        return self

    @property
    def shortest_period(self) -> float | None:
        """Shortest period of the platform's motion (s)."""
        if self.platform is None:
            return None
        motions = (self.platform.surge, self.platform.heave, self.platform.pitch)
        periods = [motion.period for motion in motions if isinstance(motion, Harmonic)]
        return min(periods, default=None)

    @property
    def lateral(self) -> str:
        """The line of the scene that calls for lateral freedom, "" when none does."""
        platform = self.platform or Platform()
        reasons = {
            "current": self.current,
            "platform.position.surge": platform.position and platform.position.surge,
            "platform.surge": platform.surge,
            "platform.pitch": platform.pitch,
            "platform.cruise": platform.cruise,
            "top.offset": self.top.offset,
            "top.lateral_force": self.top.lateral_force,
            "riser.lateral_load": [s for s in self.riser if s.lateral_load] or None,
        }
        return next((name for name, value in reasons.items() if value is not None), "")
