"""Soil around a conductor: springs that are linear, of soft clay, sand or a table, and parallel dashpots."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.soil import LinearSoil, SoftClay, TabulatedSprings, py_of_clay, py_of_table
from riserstudy.effects.soil_damping import SoilDamping
from riserstudy.model.layout import Layout
from riserstudy.model.mesh import Mesh
from riserstudy.model.model import Effect
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.riser import Section
from riserstudy.scene.soil import ElasticSoil, Matlock, Sand, Soil, TabulatedSoil

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

# ultimate resistance / (shear strength x diameter) where clay flows around the conductor
DEEP = 9.0
SHALLOW = 3.0  # the same at the mudline
CYCLIC = 0.9  # A of sand under cyclic loading
SATURATED = 8.0  # argument of tanh from which the resistance of sand is constant: 1 - tanh is 2e-7
PIECES = 64  # pieces of a curve of sand
AT_REST = 0.4  # coefficient of earth pressure at rest


def soil(of: Layout) -> Iterator[Effect]:
    """Soil around the lowest sections."""
    ground = of.scene.soil
    if ground is None:
        return
    held = springs(ground, of.scene.riser, of.mesh, of.bottom)
    yield Effect("soil", held, "soil")
    if ground.damping and ground.damping.ratio:
        stiffness = secant_stiffness(held, ground.damping.at_displacement)
        dashpots = SoilDamping(held.node, ground.damping.time * stiffness)
        yield Effect("soil damping", dashpots, "soil.damping")


def springs(
    soil: Soil, riser: list[Section], mesh: Mesh, bottom: float
) -> LinearSoil | SoftClay | TabulatedSprings:
    """Springs at the nodes; each represents the part of its two half segments that is below the mudline.

    Where the diameters of two sections meet at a node, each half segment has a spring of its own. ``bottom``:
    elevation of the lowest node (m).
    """
    nodes = bottom + mesh.s
    # the last one is that of a telescopic joint, a section of the mesh alone
    diameters = np.array([*(section.outer_diameter or 0.0 for section in riser), 0.0])[mesh.section]
    both = np.flatnonzero(diameters[1:] != diameters[:-1]) + 1  # nodes with two springs
    edges = np.concatenate([nodes[:1], 0.5 * (nodes[1:] + nodes[:-1]), nodes[-1:]])
    edges = np.sort(np.concatenate([edges, nodes[both]]))
    held = np.sort(np.concatenate([np.arange(len(nodes)), both]))
    segment = np.searchsorted(nodes[1:-1], 0.5 * (edges[1:] + edges[:-1]))
    tops = np.minimum(edges[1:], soil.mudline)
    length = tops - edges[:-1]
    below = length > 0.0
    held, length, diameter = held[below], length[below], diameters[segment[below]]
    least, most = soil.mudline - tops[below], soil.mudline - edges[:-1][below]
    depth = 0.5 * (least + most)
    of = soil.resistance
    if isinstance(of, ElasticSoil):
        return LinearSoil(held, of.stiffness * length)
    if isinstance(of, Matlock):
        y50 = 2.5 * of.strain_at_half_strength * diameter
        ultimate = ultimate_resistance(of, depth, diameter)
        return SoftClay(held, ultimate * length, y50, of.straight_up_to)
    if isinstance(of, Sand):
        return _tabulated(held, length, _py_of_sand(of, depth, diameter))
    return _tabulated(held, length, _py_of_table(of, least, most))


def secant_stiffness(
    springs: LinearSoil | SoftClay | TabulatedSprings, displacement: float | None
) -> FloatArray:
    """Ratio of resistance to displacement (m) of each spring, (k,), N/m; constant for linear springs."""
    if isinstance(springs, LinearSoil):
        return springs.stiffness
    if displacement is None:
        raise TypeError("the secant stiffness of a curve needs a displacement")
    curve = py_of_clay if isinstance(springs, SoftClay) else py_of_table
    count = len(springs.node)
    return np.array([curve.py_func(springs, k, displacement)[0] for k in range(count)]) / displacement


def ultimate_resistance(clay: Matlock, depth: FloatArray, diameter: float | FloatArray) -> FloatArray:
    """Largest resistance per length of conductor (N/m), in the shape of the depths below the mudline (m).

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


def sand_coefficients(friction_angle: float) -> tuple[float, float, float]:
    """C1, C2 and C3 of the ultimate resistance of sand, for an angle of internal friction (rad).

    References
    ----------
    Reese, Cox and Koop (1974), OTC 2080: a wedge near the mudline and flow deeper down; API RP 2A-WSD, 6.8.6,
    plots the three as curves.
    """
    phi, a, b = friction_angle, 0.5 * friction_angle, 0.25 * math.pi + 0.5 * friction_angle
    active = math.tan(0.25 * math.pi - 0.5 * phi) ** 2
    rub = math.tan(phi) * math.sin(b)
    less = math.tan(b - phi)
    wedge = math.tan(b) ** 2 * math.tan(a) / less
    wedge += AT_REST * (rub / (math.cos(a) * less) + math.tan(b) * (rub - math.tan(a)))
    flow = active * (math.tan(b) ** 8 - 1.0) + AT_REST * math.tan(phi) * math.tan(b) ** 4
    return wedge, math.tan(b) / less - active, flow


def sand_resistance(sand: Sand, depth: FloatArray, diameter: FloatArray) -> FloatArray:
    """A p_u of sand (N/m), its largest resistance, in the shape of the depths (m) and diameters (m)."""
    c1, c2, c3 = sand_coefficients(sand.friction_angle)
    weight = sand.submerged_unit_weight * depth
    ultimate = np.minimum((c1 * depth + c2 * diameter) * weight, c3 * diameter * weight)
    if sand.loading == "cyclic":
        return np.asarray(CYCLIC * ultimate)
    return np.asarray(np.maximum(3.0 - 0.8 * depth / diameter, CYCLIC) * ultimate)


def _py_of_sand(sand: Sand, depth: FloatArray, diameter: FloatArray) -> list[PPoly]:
    """p-y curves of sand, interpolated by values and slopes."""
    from scipy.interpolate import CubicHermiteSpline, PPoly  # loaded where needed: it takes long

    most = sand_resistance(sand, depth, diameter)
    share = np.linspace(0.0, SATURATED, PIECES + 1)
    rise = np.tanh(share)
    curve = CubicHermiteSpline(share, rise, 1.0 - rise**2)
    found = []
    for p, stiffness in zip(most, sand.initial_modulus * depth, strict=True):
        size = p / stiffness  # displacement at which the argument of tanh is 1 (m)
        powers = np.array([size**-3, size**-2, 1.0 / size, 1.0])[:, None]
        found.append(PPoly(p * curve.c * powers, size * share))
    return found


def _py_of_table(of: TabulatedSoil, least: FloatArray, most: FloatArray) -> list[PPoly]:
    """Mean p-y curves of a table between two depths each (m); linear between the cubics of adjacent depths.

    A mean also counts layers that are thinner than a segment.
    """
    from scipy.interpolate import PchipInterpolator, PPoly  # loaded where needed: it takes long

    known = np.array([*of.curves])
    every = np.unique([0.0, *(row.displacement for row in of.table)])
    pieces = []
    for rows in of.curves.values():
        y, p = np.array([(0.0, 0.0), *rows]).T
        own = PchipInterpolator(y, p)
        on = PPoly(own.c, own.x)
        c = np.zeros((4, len(every) - 1))
        for j, start in enumerate(every[:-1]):
            for power in range(4):
                value = on(start, power) if start < y[-1] else (p[-1] if power == 0 else 0.0)
                c[3 - power, j] = value / math.factorial(power)
        pieces.append(c)
    shares = _mean_shares(known, least, most)
    return [PPoly(np.tensordot(share, np.stack(pieces), 1), every) for share in shares]


def _mean_shares(known: FloatArray, least: FloatArray, most: FloatArray) -> FloatArray:
    """Shares of values at known depths in the mean between two depths each, (k, known); linear in between."""
    depths = np.unique(np.concatenate([known, least, most]))
    values = np.stack([np.interp(depths, known, one) for one in np.eye(len(known))], axis=1)
    parts = 0.5 * np.diff(depths)[:, None] * (values[1:] + values[:-1])
    integral = np.vstack([np.zeros(len(known)), np.cumsum(parts, axis=0)])
    start, end = np.searchsorted(depths, least), np.searchsorted(depths, most)
    length = most - least
    at_one = values[start]
    return np.where(
        (length > 0.0)[:, None],
        (integral[end] - integral[start]) / np.where(length > 0.0, length, 1.0)[:, None],
        at_one,
    )


def _tabulated(node: NDArray[np.int64], length: FloatArray, curves: list[PPoly]) -> TabulatedSprings:
    """Springs with curves per length of conductor, one for each node."""
    force = [own * curve.c for own, curve in zip(length, curves, strict=True)]
    energy = [own * curve.antiderivative().c for own, curve in zip(length, curves, strict=True)]
    return TabulatedSprings(
        node, np.stack([c.x for c in curves]), np.stack(force, axis=1), np.stack(energy, axis=1)
    )


def pile_length(soil: Soil, conductor: Section, bending: float) -> float:
    """Length (4 EI / k)^(1/4) of a conductor in bending (m), with the soil stiffness k one diameter deep.

    For clay and sand, k is the secant at half of the resistance; for a table, the secant to its first point.
    """
    of, diameter = soil.resistance, conductor.outer_diameter or 0.0
    deep = np.array([diameter])
    if isinstance(of, ElasticSoil):
        k = of.stiffness
    elif isinstance(of, Matlock):
        y50 = 2.5 * of.strain_at_half_strength * diameter
        k = 0.5 * float(ultimate_resistance(of, deep, diameter)[0]) / y50
    elif isinstance(of, Sand):
        k = 0.5 / math.atanh(0.5) * of.initial_modulus * diameter
    else:
        curve = _py_of_table(of, deep, deep)[0]
        k = max(float(curve(curve.x[1]) / curve.x[1]), 1.0)
    return float((4.0 * bending / k) ** 0.25)
