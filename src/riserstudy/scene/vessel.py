"""A platform that floats freely, what drives it, and the soil around a conductor."""

from __future__ import annotations

import math
from typing import Annotated, Self

from pydantic import Field, model_validator

from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE, Strict

ALONG_X = 1e-12  # sine of a heading that is in the plane of x and z


class Wind(Strict):
    """Wind on the platform, C |u| u by relative velocity. Absent heading: along x."""

    drag: Annotated[u.QuadraticDrag, NOT_NEGATIVE]
    speed: u.Speed
    heading: u.Angle | None = None


class WaveDrift(Strict):
    """Mean second-order force of the waves. Absent heading: along x."""

    force: Annotated[u.Force, NOT_NEGATIVE]
    heading: u.Angle | None = None


class SidewaysThrust(Strict):
    """Gains of the thrusters across the hull. Absent velocity_gain: no damping."""

    gain: Annotated[u.Stiffness, NOT_NEGATIVE]
    velocity_gain: Annotated[u.Damping, NOT_NEGATIVE] | None = None


class Turning(Strict):
    """Moment G (psi_c - psi) - D d psi/dt towards the commanded turn psi_c from the heading at rest.

    Absent command: no turn; velocity_gain: no damping; saturation: moment without limit.
    """

    gain: Annotated[u.RotationalStiffness, NOT_NEGATIVE]
    command: u.Angle | None = None
    velocity_gain: Annotated[u.RotationalDamping, NOT_NEGATIVE] | None = None
    saturation: Annotated[u.Moment, POSITIVE] | None = None


class Thrusters(Strict):
    """Thrust G (x_c - x) - D v towards the commanded place x_c, counted from above the well.

    Gains are along the hull as it lies at rest. Absent heading: the command is along x; velocity_gain: no
    damping; saturation: thrust without limit, else of its size in all directions; rise: the command is
    there at once, else it comes up as 1 - exp(-t / rise); lag: thrust is there at once, else it follows
    with this time constant; sway, yaw: no thrust across the hull, no moment.
    """

    gain: Annotated[u.Stiffness, NOT_NEGATIVE]
    command: u.Length
    heading: u.Angle | None = None
    velocity_gain: Annotated[u.Damping, NOT_NEGATIVE] | None = None
    saturation: Annotated[u.Force, POSITIVE] | None = None
    rise: Annotated[u.Time, POSITIVE] | None = None
    lag: Annotated[u.Time, POSITIVE] | None = None
    sway: SidewaysThrust | None = None
    yaw: Turning | None = None


class Sway(Strict):
    """Freedom across the hull. Absent added mass, hull drag: none across the hull."""

    added_mass: Annotated[u.Mass, NOT_NEGATIVE] | None = None
    hull_drag: Annotated[u.QuadraticDrag, NOT_NEGATIVE] | None = None


class Yaw(Strict):
    """Freedom to turn about the vertical through the riser's top.

    Absent added inertia, hull drag (C |dpsi/dt| dpsi/dt): none. The riser resists as a spring where its
    sections have a shear modulus.
    """

    inertia: Annotated[u.Inertia, POSITIVE]
    added_inertia: Annotated[u.Inertia, NOT_NEGATIVE] | None = None
    hull_drag: Annotated[u.RotationalDrag, NOT_NEGATIVE] | None = None


class Vessel(Strict):
    """A platform that floats freely from its place at rest, with the riser's top.

    Absent added mass, hull drag (by velocity relative to the current at the surface), wind, wave drift,
    thrusters: none. Absent sway: it moves along x alone; yaw: it keeps its heading; heading: its hull lies
    along x. Where everything acts along x it does not sway or turn, and is not given the freedom to.
    """

    mass: Annotated[u.Mass, POSITIVE]
    added_mass: Annotated[u.Mass, NOT_NEGATIVE] | None = None
    hull_drag: Annotated[u.QuadraticDrag, NOT_NEGATIVE] | None = None
    heading: u.Angle | None = None
    sway: Sway | None = None
    yaw: Yaw | None = None
    wind: Wind | None = None
    wave_drift: WaveDrift | None = None
    thrusters: Thrusters | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        thrusters = self.thrusters
        if self.yaw and self.sway is None:
            raise ValueError("yaw needs sway")
        if thrusters and thrusters.sway and self.sway is None:
            raise ValueError("thrusters.sway needs sway")
        if thrusters and thrusters.yaw and self.yaw is None:
            raise ValueError("thrusters.yaw needs yaw")
        if self.sway is None and (self.heading or _oblique(thrusters)):
            raise ValueError("a heading of the hull or of the command needs sway")
        return self

    @property
    def turned(self) -> str:
        """What makes it sway or turn where it may, "" when nothing does; current and waves apart."""
        if self.sway is None:
            return ""
        thrusters, yaw = self.thrusters, self.thrusters and self.thrusters.yaw
        reasons = {
            "vessel.heading": _oblique(self),
            "vessel.wind.heading": _oblique(self.wind),
            "vessel.wave_drift.heading": _oblique(self.wave_drift),
            "vessel.thrusters.heading": _oblique(thrusters),
            "vessel.thrusters.yaw.command": bool(yaw and yaw.command),
        }
        return next((name for name, asked in reasons.items() if asked), "")


def _oblique(of: Vessel | Wind | WaveDrift | Thrusters | None) -> bool:
    """Whether its heading leads out of the plane of x and z."""
    return of is not None and abs(math.sin(of.heading or 0.0)) > ALONG_X


class Matlock(Strict):
    """Soft clay under static load, by Matlock's p-y curves.

    Undrained shear strength grows linearly with depth. Up to the share ``straight_up_to`` of y50 the
    curve, which is infinitely stiff at its origin, is replaced by a straight line.
    """

    strength_at_mudline: Annotated[u.Modulus, NOT_NEGATIVE]
    strength_gradient: Annotated[u.ForcePerVolume, NOT_NEGATIVE]
    submerged_unit_weight: Annotated[u.ForcePerVolume, POSITIVE]
    strain_at_half_strength: Annotated[float, Field(gt=0, lt=1)]
    depth_factor: Annotated[float, Field(ge=0)]
    straight_up_to: Annotated[float, Field(gt=0, le=1)]


class ElasticSoil(Strict):
    """Springs of constant stiffness per length of conductor."""

    stiffness: Annotated[u.Modulus, POSITIVE]


class Soil(Strict):
    """Soil around the riser's lowest part, from its mudline down."""

    mudline: u.Length
    resistance: Matlock | ElasticSoil
