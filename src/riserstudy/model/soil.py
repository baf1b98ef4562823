"""Springs that soil around a conductor is: linear, or of soft clay."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.soil import LinearSoil, SoftClay
from riserstudy.model.layout import Layout
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Effect
from riserstudy.scene.riser import Section
from riserstudy.scene.soil import ElasticSoil, Matlock, Soil

DEEP = 9.0  # ultimate resistance over shear strength and diameter where clay flows around the conductor
SHALLOW = 3.0  # the same at the mudline


def soil(of: Layout) -> Iterator[Effect]:
    """Soil around the lowest section."""
    if of.scene.soil:
        record = springs(of.scene.soil, of.scene.riser[0], of.mesh, of.bottom)
        yield Effect("soil", record, "soil")


def springs(soil: Soil, conductor: Section, mesh: Mesh, bottom: float) -> LinearSoil | SoftClay:
    """Springs at the nodes, each for the part of its two half segments that is below the mudline.

    ``bottom``: elevation of the lowest node (m).
    """
    nodes = bottom + mesh.s
    edges = np.concatenate([nodes[:1], 0.5 * (nodes[1:] + nodes[:-1]), nodes[-1:]])
    tops = np.minimum(edges[1:], soil.mudline)
    length = tops - edges[:-1]
    held = np.flatnonzero(length > 0.0)
    length = length[held]
    depth = soil.mudline - 0.5 * (tops[held] + edges[held])
    if isinstance(soil.resistance, ElasticSoil):
        return LinearSoil(held, soil.resistance.stiffness * length)
    diameter = conductor.outer_diameter or 0.0
    clay = soil.resistance
    y50 = 2.5 * clay.strain_at_half_strength * diameter
    ultimate = ultimate_resistance(clay, depth, diameter)
    return SoftClay(held, ultimate * length, np.full(len(held), y50), clay.straight_up_to)


def ultimate_resistance(
    clay: Matlock, depth: NDArray[np.float64], diameter: float
) -> NDArray[np.float64]:
    """Largest resistance per length of conductor (N/m), shape of the depths below the mudline (m).

    References
    ----------
    Matlock (1970), OTC 1204: a wedge near the mudline, flow around the pile (9 c D) deeper down.
    """
    strength = clay.strength_at_mudline + clay.strength_gradient * depth
    shallow = (
        SHALLOW * strength
        + clay.submerged_unit_weight * depth
        + clay.depth_factor * strength * depth / diameter
    )
    return np.asarray(np.minimum(shallow, DEEP * strength) * diameter)


def pile_length(soil: Soil, conductor: Section, bending: float) -> float:
    """Length (4 EI / k)^(1/4) of a conductor in bending (m), with soil as stiff as a diameter deep at y50."""
    if isinstance(soil.resistance, ElasticSoil):
        k = soil.resistance.stiffness
    else:
        clay, diameter = soil.resistance, conductor.outer_diameter or 0.0
        y50 = 2.5 * clay.strain_at_half_strength * diameter
        k = 0.5 * float(ultimate_resistance(clay, np.array([diameter]), diameter)[0]) / y50
    return float((4.0 * bending / k) ** 0.25)
