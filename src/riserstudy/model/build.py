"""A scene and a mesh become a model: which effects there are, with which records, and why."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from riserstudy.effects.axial import Axial
from riserstudy.effects.axial_damping import AxialDamping
from riserstudy.effects.bending import Bending
from riserstudy.effects.bending_damping import BendingDamping
from riserstudy.effects.bending_damping_in_space import SpatialBendingDamping
from riserstudy.effects.bending_in_space import SpatialBending
from riserstudy.effects.current import Current
from riserstudy.effects.dead_load import DeadLoad
from riserstudy.effects.end_mass import EndMass
from riserstudy.effects.flex_joint import FlexJoint
from riserstudy.effects.flex_joint_in_space import SpatialFlexJoint
from riserstudy.effects.foreshortening import Foreshortening
from riserstudy.effects.inertia import Inertia
from riserstudy.effects.support import Support
from riserstudy.effects.tension_loss import TensionLoss
from riserstudy.effects.weight import Weight
from riserstudy.model.hydrodynamics import wave_of, wet
from riserstudy.model.initial_shape import between_ends, under_a_joint
from riserstudy.model.joints import devices
from riserstudy.model.mesh import Mesh, blend_by_weight
from riserstudy.model.model import Effect, Model
from riserstudy.model.platform_motion import centre, motions
from riserstudy.model.sea import current_table
from riserstudy.model.tensioners import in_space, laws, pistons, upright
from riserstudy.model.vessel import loose_nodes, unknowns
from riserstudy.scene.ends import Areas, Body, BodyAddedMass, Rotation
from riserstudy.scene.ends import FlexJoint as Joint
from riserstudy.scene.models import Scene
from riserstudy.scene.riser import Section
from riserstudy.solve.state import OTHER, OWN

FloatArray = NDArray[np.float64]
TAUT = 1e-6  # strain of a hanging riser in the first guess
AXES = {1: [2], 2: [0, 2], 3: [0, 1, 2]}  # which of x, y, z a model of so many directions has


class Stiffness(NamedTuple):
    """Stiffness and inner area of a section."""

    axial: float  # EA (N)
    bending: float  # EI (N m2), 0 for a string
    bore: float  # inner area (m2)


def stiffness(section: Section) -> Stiffness:
    """EA, EI and bore of a section."""
    return Stiffness(*section.elasticity, 0.25 * math.pi * (section.inner_diameter or 0.0) ** 2)


def directions(scene: Scene) -> int:
    """Directions that the scene needs: 1 along the riser, 2 in a plane, 3 in space."""
    if scene.spatial:
        return 3
    return 2 if scene.lateral else 1


def build(
    scene: Scene,
    mesh: Mesh,
    ring_elevation: float | None = None,
    d: int | None = None,
) -> Model:
    """Model of a scene on a mesh.

    Parameters
    ----------
    ring_elevation : elevation of the riser's top found by an earlier statics (m): where it is held, or
        where tensioners are at mid-stroke.
    d : directions, if more than the scene needs (modes, stability).
    """
    return _Builder(scene, mesh, d or directions(scene), ring_elevation).model()


class _Builder:
    def __init__(self, scene: Scene, mesh: Mesh, d: int, ring_elevation: float | None):
        self.scene, self.mesh, self.d = scene, mesh, d
        self.n, self.ring = len(mesh.l0), mesh.ring
        self.g = scene.gravity or 0.0
        self.rho = scene.water.density if scene.water else 0.0
        self.effects: list[Effect] = []
        self.fixed: list[tuple[int, int]] = []
        self.loose = loose_nodes(scene, d)
        self.afloat: list[tuple[int, int]] = []
        self.probes: list[str] = []
        self.parts = [stiffness(section) for section in scene.riser]
        self.axial = self.per_segment(lambda s, k: self.parts[k].axial)
        bends = d > 1 and all(part.bending > 0 for part in self.parts)
        self.m = {2: 1, 3: 3}[d] if bends else 0
        self.bottom_z = scene.bottom.elevation or 0.0
        if scene.bottom.hold == "free":
            self.bottom_z = (scene.top.elevation or 0.0) - float(mesh.l0.sum())
        self.ring_z = ring_elevation
        self.top_z = scene.top.elevation
        if self.top_z is None:
            self.top_z = ring_elevation
        if self.ring_z is None and not mesh.joint:
            self.ring_z = self.top_z

    def add(self, name: str, record: Any, because: str) -> None:
        self.effects.append(Effect(name, record, because))

    def per_segment(self, value: Any, joint: float = 0.0) -> FloatArray:
        """``value(section, k)`` of the section that each segment belongs to, ``joint`` of the joint."""
        values = [float(value(section, k)) for k, section in enumerate(self.scene.riser)]
        return np.array([*values, joint])[self.mesh.section]

    def model(self) -> Model:
        if self.scene.platform:
            self.effects += motions(self.scene.platform, self.scene.wave)
        self.supports()
        self.current()
        self.wave()
        self.string()
        self.ends()
        self.tensioners()
        self.effects += devices(
            self.scene, self.mesh, self.bottom_z, bool(self.m), self.d, self.probes
        )
        explicit = self.scene.analysis.method == "explicit"
        share = (0.5, 0.0) if explicit else (OWN, OTHER)
        tensioners = self.scene.top.tensioners
        model = Model(
            self.mesh.l0,
            self.d,
            self.m,
            self.effects,
            self.fixed,
            share,
            tensioners.count if tensioners else 0,
            self.ring if self.mesh.joint else None,
            self.probes,
            self.afloat,
            self.loose,
        )
        model.s.r[:, : self.n + 1] = self.guess()
        for state in (model.s, model.spare.value):
            blend_by_weight(state.blend, self.mesh, self.weight)
        return model

    # what holds and flows

    def hold(
        self, node: int, place: list[float], held: list[bool], follow: list[bool], why: str
    ) -> None:
        """Hold a node in some of (x, y, z)."""
        axes = np.array(AXES[self.d])
        record = Support(
            node,
            np.array(place),
            axes,
            np.array(held, np.int64)[axes],
            np.array(follow, np.int64)[axes],
            np.array(place) - centre(self.scene.platform),
            np.zeros((3, 3)),
        )
        self.add("support", record, why)
        self.fixed += [(node, self.m + k) for k in range(self.d) if record.held[k]]

    def supports(self) -> None:
        bottom, top = self.scene.bottom, self.scene.top
        if bottom.hold == "wellhead":
            self.hold(0, [0.0, 0.0, self.bottom_z], [True] * 3, [False] * 3, "bottom.hold")
        if bottom.hold == "foot":
            place = [0.0, 0.0, self.bottom_z]
            self.hold(0, place, [False, False, True], [False] * 3, "bottom.hold")
        held = [top.x not in (None, "free")] * 2 + [top.z != "free"]
        if top.x == "vessel":
            free = unknowns(self.scene, self.d, self.n)
            self.afloat = [(node, self.m + k) for node, k in free]
            held[0], held[1] = False, (self.n, 1) not in free
            for node in range(self.n + 1, self.n + 1 + self.loose):
                every = {(node, k) for k in range(self.m + self.d)}
                self.fixed += every.difference(self.afloat)
        if any(held[k] for k in AXES[self.d]):
            follow = [top.x == "platform"] * 2 + [top.z == "platform"]
            # free in z, it turns with the platform from where the riser ends before it stretches
            high = self.bottom_z + float(self.mesh.l0.sum()) if self.top_z is None else self.top_z
            place = [top.offset or 0.0, 0.0, high]
            self.hold(self.n, place, held, follow, "top.x, top.z")
        for node, end in ((0, bottom), (self.n, top)):
            if flexibility_of(end.rotation) is None:
                self.fixed += [(node, u) for u in range(self.m)]

    def current(self) -> None:
        current = self.scene.current
        if current is None or self.d == 1:
            return
        z, speed = current_table(current, self.scene.water)
        along = self.along(current.towards)
        near = np.zeros(self.n + 1, np.int64)
        self.add("current", Current(z, speed, along, near, current.ramp or 0.0), "current")

    def along(self, heading: float | None) -> FloatArray:
        """Unit vector of a heading in the horizontal directions of the model."""
        return np.array([math.cos(heading or 0.0), math.sin(heading or 0.0)])[: self.d - 1]

    def wave(self) -> None:
        sea, water = self.scene.wave, self.scene.water
        if sea is None or water is None or self.d == 1:
            return
        self.add("wave", wave_of(sea, water, self.g, self.along(sea.heading)), "wave")

    # the string

    def string(self) -> None:
        l0 = self.mesh.l0
        sections = self.scene.riser
        self.add("axial elasticity", Axial(self.axial / l0), "riser")
        relaxation = [
            d.ratio * d.at_period / math.pi if (d := s.structural_damping) else 0.0
            for s in sections
        ]
        if any(relaxation):
            damping = self.axial * self.per_segment(lambda s, k: relaxation[k]) / l0
            self.add("axial damping", AxialDamping(damping), "riser.structural_damping")
        if self.m:
            self.bending(relaxation[0])
        weight = self.per_segment(
            lambda s, k: (
                (s.submerged_weight or 0.0)
                + (s.contents.density * self.parts[k].bore * self.g if s.contents else 0.0)
            )
        )
        self.weight = weight
        if np.any(weight):
            self.add("weight", Weight(self.d - 1, halves(-weight * l0)), "riser.submerged_weight")
        load = self.per_segment(lambda s, k: s.lateral_load or 0.0)
        if np.any(load) and self.d > 1:
            self.add("line load", Weight(0, halves(load * l0)), "riser.lateral_load")
        mass = self.per_segment(lambda s, k: s.mass or 0.0) * l0
        if np.any(mass):
            self.add("inertia", Inertia(mass, -mass), "riser.mass")
        self.effects += wet(self.scene, self.mesh, self.d)

    def bending(self, relaxation: float) -> None:
        why = "riser.young_modulus or bending_stiffness"
        bottom, top = self.scene.bottom, self.scene.top
        joint = top.telescopic_joint
        stiff = self.per_segment(
            lambda s, k: self.parts[k].bending, joint.bending_stiffness if joint else 0.0
        )
        flexibility = self.mesh.l0 / stiff
        own, other = np.full(self.n, OWN), np.full(self.n, OTHER)
        linear = [0] if flexibility_of(bottom.rotation) is not None else []
        linear += [-1] if flexibility_of(top.rotation) is not None else []
        linear += [-1, -2] if joint else []  # the moment has a corner at the ring
        for k in self.cornered():
            linear += [self.mesh.foot(k) - 1, self.mesh.foot(k)]  # and where a body or joint is
        own[linear], other[linear] = 1.0 / 3.0, 1.0 / 6.0
        flex = np.zeros(self.n + 1)
        flex[:-1] += own * flexibility
        flex[1:] += own * flexibility
        self.bend = np.stack([own * flexibility, other * flexibility], axis=1)
        record: Any = (Bending if self.m == 1 else SpatialBending)(flex, other * flexibility)
        self.add("bending", record, why)
        self.add("foreshortening", Foreshortening(self.axial * flexibility**2 / 72.0), why)
        if relaxation:
            if self.m == 1:
                record = BendingDamping(relaxation, *np.zeros((2, self.n + 1)))
            else:
                record = SpatialBendingDamping(relaxation, *np.zeros((2, 3, self.n + 1)))
            self.add("bending damping", record, "riser.structural_damping")
        for node, end, name in ((0, bottom, "bottom"), (self.n, top, "top")):
            soft = flexibility_of(end.rotation)
            if soft is None:
                continue
            follows = name == "top" and top.x == "platform"
            if self.m == 1:
                record = FlexJoint(node, soft, 0.0, float(follows))
            else:
                upwards = np.array([0.0, 0.0, 1.0])
                held = np.stack([upwards, *np.zeros((2, 3))])
                record = SpatialFlexJoint(node, soft, upwards, int(follows), held)
            self.add("flex joint" if soft > 0.0 else "clamp", record, f"{name}.rotation")

    # what is attached

    def ends(self) -> None:
        bottom, top = self.scene.bottom, self.scene.top
        if bottom.body and bottom.body.reach:
            low = (bottom.body.centre_below or 0.0) / bottom.body.reach
            self.body(bottom.body, 0, low, "bottom.body")
            self.body(bottom.body, self.mesh.foot(1), 1.0 - low, "bottom.body")
        elif bottom.body:
            self.body(bottom.body, 0, 1.0, "bottom.body")
        if top.body:
            self.body(top.body, self.ring, 1.0, "top.body")
        if top.tension:
            load = np.zeros(self.d)
            load[-1] = top.tension
            self.add("constant tension", DeadLoad(self.ring, load), "top.tension")
            if loss := top.tension_loss:
                lost = TensionLoss(self.ring, -loss.share * load, loss.at, loss.over)
                self.add("tension loss", lost, "top.tension_loss")
        if top.lateral_force and self.d > 1:
            load = np.zeros(self.d)
            load[0] = top.lateral_force
            self.add("lateral force", DeadLoad(self.ring, load), "top.lateral_force")

    def body(self, body: Body, node: int, share: float, why: str) -> None:
        """A share of a body at a node."""
        extra = body.added_mass or BodyAddedMass()
        area = body.drag_area or Areas()
        mass = np.full(self.d, body.mass)
        mass[-1] += extra.vertical or 0.0
        mass[:-1] += extra.horizontal or 0.0
        drag = 0.5 * self.rho * np.array([area.horizontal or 0.0, area.vertical or 0.0])
        weight = body.weight(self.g, self.rho)
        self.add("end mass", EndMass(node, share * weight, share * mass, share * drag), why)

    def cornered(self) -> list[int]:
        """Sections above a node where the moment has a corner."""
        rigid = self.scene.bottom.body is not None and self.scene.bottom.body.reach > 0.0
        return [*self.jointed(), *([1] if rigid else [])]

    def jointed(self) -> list[int]:
        """Sections with a flex joint below them."""
        return [k for k, section in enumerate(self.scene.riser) if section.flex_joint_below]

    def tensioners(self) -> None:
        rig = self.scene.top.tensioners
        if rig is None:
            return
        self.effects += laws(rig, self.g)
        self.effects += pistons(rig, self.ring, self.d)
        elevation = self.bottom_z + self.mesh.riser_length
        if rig.mid_stroke == "riser in equilibrium" and self.ring_z is not None:
            elevation = self.ring_z
        if rig.arrangement is None:
            self.effects.append(upright(rig, self.ring, elevation))
            return
        bend = self.bend[[-2, -1]] if self.m and self.mesh.joint else np.zeros((2, 2))
        self.effects.append(
            in_space(rig, rig.arrangement, self.ring, elevation, centre(self.scene.platform), bend)
        )

    def guess(self) -> FloatArray:
        """The shape that statics start from, (d, n+1)."""
        total = float(self.mesh.l0.sum())
        offset = (self.scene.top.offset or 0.0) if self.d > 1 else 0.0
        rise = total if self.top_z is None else self.top_z - self.bottom_z
        joint = self.scene.top.telescopic_joint
        if joint:
            k = max(self.jointed(), default=int(self.scene.soil is not None))
            foot = min(self.mesh.foot(k), self.n - 1)
            strain = (joint.tension or 0.0) / self.axial[:-1]
            shape = under_a_joint(self.mesh, foot, strain, offset, rise)
        else:
            weight = float(self.weight @ self.mesh.l0)
            shape = between_ends(self.mesh, offset, rise, weight, float(self.axial.min()))
        shape[2] += self.bottom_z
        if self.scene.bottom.hold == "free":  # slack and straight it would swing without resistance
            shape[2] -= TAUT * (total - self.mesh.s)
        return shape[AXES[self.d]]


def flexibility_of(rotation: Rotation | None) -> float | None:
    """1/K of what holds an end in direction (rad/(N m)), 0 for a clamp, None where it turns freely."""
    if isinstance(rotation, Joint):
        return 1.0 / rotation.stiffness if rotation.stiffness > 0.0 else None
    return 0.0 if rotation == "fixed" else None


def halves(segment: FloatArray) -> FloatArray:
    """Half of each segment's load to either node."""
    nodes = np.zeros(len(segment) + 1)
    nodes[:-1] += 0.5 * segment
    nodes[1:] += 0.5 * segment
    return nodes
