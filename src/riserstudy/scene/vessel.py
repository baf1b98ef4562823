"""A platform that is free to surge, and what drives it."""

from __future__ import annotations

import math
from typing import Annotated

from pydantic import Field

from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE, Strict


class Wind(Strict):
    """Wind on the platform, C |u| u by relative velocity. Absent heading: along x."""

    drag: Annotated[u.QuadraticDrag, NOT_NEGATIVE]
    speed: u.Speed
    heading: u.Angle | None = None


class WaveDrift(Strict):
    """Mean second-order force of the waves. Absent heading: along x."""

    force: Annotated[u.Force, NOT_NEGATIVE]
    heading: u.Angle | None = None

    @property
    def along(self) -> float:
        """Its part along x (N)."""
        return self.force * math.cos(self.heading or 0.0)


class Thrusters(Strict):
    """Thrust G (x_c - x) - D v towards the commanded place x_c, counted from above the well.

    Absent velocity_gain: no damping; saturation: thrust without limit; rise: the command is there at
    once, else it comes up as 1 - exp(-t / rise).
    """

    gain: Annotated[u.Stiffness, NOT_NEGATIVE]
    command: u.Length
    velocity_gain: Annotated[u.Damping, NOT_NEGATIVE] | None = None
    saturation: Annotated[u.Force, POSITIVE] | None = None
    rise: Annotated[u.Time, POSITIVE] | None = None


class Vessel(Strict):
    """A platform that surges freely from its place at rest, with the riser's top; it does not sway.

    Absent added mass, hull drag (by velocity relative to the current at the surface), wind, wave drift,
    thrusters: none.
    """

    mass: Annotated[u.Mass, POSITIVE]
    added_mass: Annotated[u.Mass, NOT_NEGATIVE] | None = None
    hull_drag: Annotated[u.QuadraticDrag, NOT_NEGATIVE] | None = None
    wind: Wind | None = None
    wave_drift: WaveDrift | None = None
    thrusters: Thrusters | None = None


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
