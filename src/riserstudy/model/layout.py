"""A scene laid out on a mesh: directions, elevations and section values by segment, before any effect."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from riserstudy.model.mesh import Mesh
from riserstudy.model.vessel import loose_nodes
from riserstudy.records.arrays import FloatArray
from riserstudy.scene.ends import FlexJoint, Rotation
from riserstudy.scene.geometry import Span, length_of, span
from riserstudy.scene.resolve import Resolved
from riserstudy.scene.riser import Section

AXES = {1: [2], 2: [0, 2], 3: [0, 1, 2]}  # axes (x, y, z) of a model, by its number of directions


class Stiffness(NamedTuple):
    """Stiffness and inner area of a section."""

    axial: float  # EA (N)
    bending: float  # EI (N m2), 0 for a string
    bore: float  # inner area (m2)


def stiffness(section: Section) -> Stiffness:
    """EA, EI and bore of a section."""
    return Stiffness(*section.elasticity, 0.25 * math.pi * (section.inner_diameter or 0.0) ** 2)


def directions(scene: Resolved) -> int:
    """Directions that the scene needs: 1 along the riser, 2 in a plane, 3 in space."""
    if scene.spatial:
        return 3
    return 2 if scene.lateral else 1


def flexibility_of(rotation: Rotation | None) -> float | None:
    """1/K of an end's rotational support (rad/(N m)), 0 for a clamp, None for an end that rotates freely."""
    if isinstance(rotation, FlexJoint):
        return 1.0 / rotation.stiffness if rotation.stiffness > 0.0 else None
    return 0.0 if rotation == "fixed" else None


class Layout(NamedTuple):
    """A scene on a mesh, with the arrays that its effects are built from."""

    scene: Resolved
    mesh: Mesh
    d: int  # directions
    m: int  # bending moments of a node
    sections: list[Stiffness]
    axial: FloatArray  # (n,) EA of the segments (N), 0 in a telescopic joint
    weight: FloatArray  # (n,) in water with contents (N/m)
    bottom: float  # elevation of the riser's lower end (m)
    top: float | None  # elevation of the upper end at rest (m); None: found by statics
    loose: int  # nodes beyond the riser's

    @property
    def gravity(self) -> float:
        """Acceleration of gravity (m/s2), 0 where the scene has none."""
        return self.scene.gravity or 0.0

    @property
    def density(self) -> float:
        """Density of the water (kg/m3), 0 without water."""
        return self.scene.water.density if self.scene.water else 0.0

    @property
    def last(self) -> int:
        """The riser's last node."""
        return len(self.mesh.l0)

    def per_segment(self, value: Callable[[int], float], joint: float = 0.0) -> FloatArray:
        """Values of the sections, in their unit, over the segments, (n,); ``joint`` of a telescopic joint."""
        return per_segment(self.scene, self.mesh, value, joint)

    def along(self, heading: float | None) -> FloatArray:
        """Unit vector of a heading (rad) in the horizontal directions of the model, (d - 1,)."""
        return np.array([math.cos(heading or 0.0), math.sin(heading or 0.0)])[: self.d - 1]

    @property
    def upright(self) -> FloatArray:
        """Elevations of the nodes of the upright riser, (n + 1,), m."""
        return np.asarray(self.bottom + self.mesh.s)

    @property
    def above_ground(self) -> FloatArray:
        """Share of each segment above the ground, (n,), 1: water exerts no forces on the part in the soil."""
        ground = self.scene.ground
        if ground is None:
            return np.ones(self.last)
        return np.clip((self.upright[1:] - ground) / self.mesh.l0, 0.0, 1.0)

    @property
    def cornered(self) -> list[int]:
        """Sections at whose lower end the shear may jump, due to a joint, a guide or a rigid body below."""
        body = self.scene.bottom.body
        first = [1] if body and body.reach else []
        return [*first, *(k for k, s in enumerate(self.scene.riser) if s.corner_below)]


def unstretched(scene: Resolved) -> Span:
    """Elevations of the ends of the unstretched riser (m); its upper end is at 0 if the scene gives none."""
    return span(scene) or Span(-length_of(scene), 0.0)


def layout_of(scene: Resolved, mesh: Mesh, ring_elevation: float | None, d: int) -> Layout:
    """Layout of a scene on a mesh in ``d`` directions.

    ``ring_elevation``: elevation of the riser's top from an earlier static solution (m); None without one.
    """
    sections = [stiffness(section) for section in scene.riser]
    bends = d > 1 and all(section.bending > 0 for section in sections)
    contents = [s.contents.density if s.contents else 0.0 for s in scene.riser]
    gravity = scene.gravity or 0.0

    def weight(k: int) -> float:
        own = scene.riser[k].submerged_weight or 0.0
        return own + contents[k] * sections[k].bore * gravity

    top = scene.top.elevation if scene.top.elevation is not None else ring_elevation
    return Layout(
        scene,
        mesh,
        d,
        {2: 1, 3: 3}[d] if bends else 0,
        sections,
        axial=per_segment(scene, mesh, lambda k: sections[k].axial),
        weight=per_segment(scene, mesh, weight),
        bottom=unstretched(scene).bottom,
        top=top,
        loose=loose_nodes(scene, d),
    )


def per_segment(scene: Resolved, mesh: Mesh, value: Callable[[int], float], joint: float = 0.0) -> FloatArray:
    """Values of the sections, in their unit, over the segments, (n,); ``joint`` of a telescopic joint."""
    values = [float(value(k)) for k in range(len(scene.riser))]
    return np.array([*values, joint])[mesh.section]


def halves(segment: FloatArray) -> FloatArray:
    """Loads of the nodes, (n + 1,): half of each segment's load, (n,), at each of its nodes; same unit."""
    nodes = np.zeros(len(segment) + 1)
    nodes[:-1] += 0.5 * segment
    nodes[1:] += 0.5 * segment
    return nodes


def corners(of: Layout) -> list[int]:
    """Nodes at which the shear, hence the slope of the moment, may jump.

    These are the ends, the ring, `Layout.cornered` and the mudline. At the mudline the resistance of the soil
    jumps; since springs at nodes represent it, the shear jumps there.
    """
    soil = of.scene.soil
    mudline = [int(np.abs(of.bottom + of.mesh.s - soil.mudline).argmin())] if soil else []
    return [0, *mudline, *(of.mesh.foot(k) for k in of.cornered), of.mesh.ring, of.last]
