"""Soil around a conductor."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE


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
