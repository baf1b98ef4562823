"""What stands around and within the riser string: soil, inner joints, a free platform, gauges."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.inner_flex_joint import InnerFlexJoint
from riserstudy.effects.sliding_tension import SlidingTension
from riserstudy.effects.soil import LinearSoil, SoftClay
from riserstudy.effects.stress_gauge import StressGauge
from riserstudy.mesh import Mesh
from riserstudy.model import Effect
from riserstudy.scene.ends import TelescopicJoint
from riserstudy.scene.models import Scene
from riserstudy.scene.string import Section
from riserstudy.scene.vessel import ElasticSoil, Matlock, Soil
from riserstudy.vessel import floating

DEEP = 9.0  # ultimate resistance over shear strength and diameter where clay flows around the conductor
SHALLOW = 3.0  # the same at the mudline


def devices(
    scene: Scene, mesh: Mesh, bottom: float, bends: bool, d: int, probes: list[str]
) -> Iterator[Effect]:
    """Their effects; names of what they report are added to ``probes``."""
    rig, joint, output = scene.top.tensioners, scene.top.telescopic_joint, scene.analysis.output

    def probe(*names: str) -> int:
        """Index of the first of some probes."""
        first = 2 * (rig.count if rig else 0) + len(probes)
        probes.extend(names)
        return first

    for k, section in enumerate(scene.riser):
        if section.flex_joint_below and bends:
            flexibility = 1.0 / section.flex_joint_below.stiffness
            inner = InnerFlexJoint(mesh.foot(k), flexibility, probe("lfj_angle"))
            yield Effect("inner flex joint", inner, f"riser[{k}].flex_joint_below")
    if scene.soil:
        yield Effect("soil", springs(scene.soil, scene.riser[0], mesh, bottom), "soil")
    if joint and joint.tension:
        sliding = sliding_tension(joint, len(mesh.l0) - 1)
        yield Effect("sliding tension", sliding, "top.telescopic_joint.tension")
    if output and output.stress_in:
        k = [section.name for section in scene.riser].index(output.stress_in)
        record = gauge(scene.riser[k], mesh, k, probe("largest_stress"))
        yield Effect("stress gauge", record, "analysis.output.stress_in")
    yield from floating(scene, d, len(mesh.l0), probe)


def springs(soil: Soil, conductor: Section, mesh: Mesh, bottom: float) -> LinearSoil | SoftClay:
    """Springs at the nodes, each for the part of its two half segments that is below the mudline."""
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
    """Largest resistance per length of conductor (N/m) at depths below the mudline (m)."""
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


def gauge(section: Section, mesh: Mesh, k: int, probe: int) -> StressGauge:
    """Gauge along section ``k``."""
    outer, inner = section.outer_diameter or 0.0, section.inner_diameter or 0.0
    fibre = 32.0 * outer / (math.pi * (outer**4 - inner**4))
    first = mesh.foot(k)
    last = first + int((mesh.section == k).sum())
    return StressGauge(first, last, section.wall_area, fibre, probe)


def sliding_tension(joint: TelescopicJoint, segment: int) -> SlidingTension:
    """Constant tension of the telescopic joint, which is one segment."""
    stop = joint.stop
    return SlidingTension(
        segment,
        joint.tension or 0.0,
        joint.length + stop.stroke if stop else math.inf,
        stop.stiffness if stop else 0.0,
    )
