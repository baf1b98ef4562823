"""Soil around a conductor."""

from __future__ import annotations

import math
from itertools import groupby, pairwise
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from riserstudy.inputs.misfit import Misfit
from riserstudy.inputs.strict import Strict
from riserstudy.scene import units as u
from riserstudy.scene.base import NOT_NEGATIVE, POSITIVE
from riserstudy.scene.damping import DampingAtPeriod


class Matlock(Strict):
    """Soft clay under static load, by Matlock's p-y curves.

    The undrained shear strength of the clay increases linearly with depth. Matlock's p-y curve (resistance as
    a function of displacement) is infinitely stiff at zero displacement. Up to a small displacement,
    ``straight_up_to`` times y50, a straight line therefore replaces Matlock's curve. The symbol y50 in
    Matlock's p-y curve is the displacement at half of the ultimate resistance.
    """

    strength_at_mudline: Annotated[u.Modulus, NOT_NEGATIVE]
    strength_gradient: Annotated[u.ForcePerVolume, NOT_NEGATIVE]
    submerged_unit_weight: Annotated[u.ForcePerVolume, POSITIVE]
    strain_at_half_strength: Annotated[float, Field(gt=0, lt=1)]
    depth_factor: Annotated[float, Field(ge=0)]
    straight_up_to: Annotated[float, Field(gt=0, le=1)]


class ElasticSoil(Strict):
    """Soil springs of constant stiffness per length of conductor."""

    stiffness: Annotated[u.Modulus, POSITIVE]


class Sand(Strict):
    """Sand by the p-y curves of API RP 2A: p = A p_u tanh(k X y / (A p_u)) at the depth X.

    In the formula of the p-y curve for sand, p_u is the ultimate resistance, y the displacement, and k
    (``initial_modulus``) the increase of the soil stiffness with depth. The factor A of the p-y curve is 0.9
    under cyclic loading. Under static loading, the factor A is 3 - 0.8 X / D with the diameter D of the
    conductor, and at least 0.9. The key ``friction_angle`` is the angle of internal friction of the sand.
    """

    friction_angle: Annotated[u.Angle, Field(gt=0, lt=math.radians(50.0))]
    submerged_unit_weight: Annotated[u.ForcePerVolume, POSITIVE]
    initial_modulus: Annotated[u.ForcePerVolume, POSITIVE]
    loading: Literal["static", "cyclic"]


class ResistanceAt(Strict):
    """Point of a p-y curve: depth below the mudline, displacement, resistance per length of conductor."""

    depth: Annotated[u.Length, NOT_NEGATIVE]
    displacement: Annotated[u.Length, POSITIVE]
    resistance: Annotated[u.ForcePerLength, NOT_NEGATIVE]


class TabulatedSoil(Strict):
    """p-y curves as a table: rows for several depths, with increasing displacements at each depth.

    Between the points of a p-y curve, the resistance is a monotone cubic function that starts at zero. Beyond
    the last point of a p-y curve, the resistance is constant. Between the depths of two p-y curves, the
    resistance is interpolated linearly. The soil spring of a node has the mean resistance over the part of
    the conductor that the node represents. The depths of a table of p-y curves must reach from the mudline to
    the lower end of the conductor.
    """

    table: Annotated[list[ResistanceAt], Field(min_length=1)]

    @model_validator(mode="after")
    def _rising(self) -> Self:
        depths = [depth for depth, _ in groupby(self.table, lambda row: row.depth)]
        if depths != sorted(set(depths)):
            raise Misfit(
                "table",
                "the depths do not increase",
                "order the rows by depth, with all rows of one depth together",
            )
        for depth, rows in self.curves.items():
            for name, values in zip(("displacement", "resistance"), zip(*rows, strict=True), strict=True):
                steps = [b - a for a, b in pairwise(values)]
                if any(step < 0.0 or (step == 0.0 and name == "displacement") for step in steps):
                    raise Misfit(
                        "table",
                        f"the {name} does not increase at the depth of {depth:g} m",
                        "order the rows of this depth by displacement and check the values",
                    )
        return self

    @property
    def curves(self) -> dict[float, list[tuple[float, float]]]:
        """Displacements (m) and resistances (N/m) by depth (m)."""
        found: dict[float, list[tuple[float, float]]] = {}
        for row in self.table:
            found.setdefault(row.depth, []).append((row.displacement, row.resistance))
        return found


class SoilDamping(DampingAtPeriod):
    """Dashpots that represent the hysteresis of the soil, parallel to the soil springs.

    The key ``ratio`` is the damping ratio (damping divided by critical damping) at one period of motion. In a
    cycle with the period ``at_period`` and the amplitude ``at_displacement``, a dashpot dissipates 4 pi
    ``ratio`` times the elastic energy of its soil spring. The elastic energy of the soil spring is computed
    with the secant stiffness. Choose a period ``at_period`` of the dashpots that is close to the period of
    motion. At periods longer than ``at_period``, a dashpot dissipates less energy per cycle, whereas the
    energy per cycle of real soil does not decrease.
    """

    at_displacement: Annotated[u.Length, POSITIVE] | None = None


class Soil(Strict):
    """Soil around the lowest sections of the riser, below the flex joint, from the mudline down.

    Below the mudline (the surface of the soil), water exerts no forces: current, waves, drag and added mass
    act only above the mudline.
    """

    mudline: u.Length
    resistance: Matlock | Sand | ElasticSoil | TabulatedSoil
    damping: SoilDamping | None = None

    @model_validator(mode="after")
    def _at_a_displacement(self) -> Self:
        if self.damping is None:
            return self
        linear, where = isinstance(self.resistance, ElasticSoil), "damping.at_displacement"
        if linear and self.damping.at_displacement is not None:
            raise Misfit(where, "has no effect on soil springs of constant stiffness", "remove it")
        if not linear and self.damping.at_displacement is None:
            found = "missing, but the stiffness of these soil springs varies with displacement"
            raise Misfit(where, found, "add it")
        return self
