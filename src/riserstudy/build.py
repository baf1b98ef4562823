"""A scene and a mesh become a model: which effects there are, with which records, and why."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from riserstudy.effects.added_mass import AddedMass
from riserstudy.effects.axial import Axial
from riserstudy.effects.axial_damping import AxialDamping
from riserstudy.effects.bending import Bending
from riserstudy.effects.bending_damping import BendingDamping
from riserstudy.effects.current import Current
from riserstudy.effects.cylinder import Upright
from riserstudy.effects.cylinder_damping import CylinderDamping
from riserstudy.effects.drag import Drag
from riserstudy.effects.end_mass import EndMass
from riserstudy.effects.end_stop import EndStop
from riserstudy.effects.flex_joint import FlexJoint
from riserstudy.effects.foreshortening import Foreshortening
from riserstudy.effects.gas_spring import GasSpring
from riserstudy.effects.inertia import Inertia
from riserstudy.effects.linear_spring import LinearSpring
from riserstudy.effects.platform_motion import Cruise, Harmonic, Position, Series
from riserstudy.effects.pull import Pull
from riserstudy.effects.support import Support
from riserstudy.effects.two_chamber_gas import TwoChamberGas
from riserstudy.effects.wave_force import WaveForce
from riserstudy.effects.weight import Weight
from riserstudy.mesh import Mesh
from riserstudy.model import Effect, Model
from riserstudy.response import harmonics
from riserstudy.scene import forcing
from riserstudy.scene.ends import Areas, BodyAddedMass, Rotation
from riserstudy.scene.ends import FlexJoint as Joint
from riserstudy.scene.models import Scene
from riserstudy.scene.string import Section
from riserstudy.sea import current_table, wave_of
from riserstudy.solve.state import OTHER, OWN
from riserstudy.tensioner_law import linear_law

FloatArray = NDArray[np.float64]
MOTION = {"surge": 0, "sway": 1, "heave": 2, "roll": 3, "pitch": 4, "yaw": 5}
GAS_FIELDS = ("area", "pressure", "volume")


class Stiffness(NamedTuple):
    """Stiffness and inner area of a section."""

    axial: float  # EA (N)
    bending: float  # EI (N m2), 0 for a string
    bore: float  # inner area (m2)


def stiffness(section: Section) -> Stiffness:
    """EA, EI and bore of a section."""
    outer, inner = section.outer_diameter or 0.0, section.inner_diameter or 0.0
    bore = 0.25 * math.pi * inner**2
    if section.young_modulus is None:
        return Stiffness(section.axial_stiffness or 0.0, section.bending_stiffness or 0.0, bore)
    area = 0.25 * math.pi * outer**2 - bore
    second = math.pi / 64.0 * (outer**4 - inner**4)
    return Stiffness(section.young_modulus * area, section.young_modulus * second, bore)


def directions(scene: Scene) -> int:
    """Directions that the scene needs: 1 along the riser, 2 in a plane."""
    return 2 if scene.lateral else 1


def build(
    scene: Scene,
    mesh: Mesh,
    top_elevation: float | None = None,
    planar: bool | None = None,
) -> Model:
    """Model of a scene on a mesh.

    Parameters
    ----------
    top_elevation : elevation of the top found by an earlier statics (m): where it is held, or where
        tensioners are at mid-stroke.
    planar : solve in a plane even if the scene needs the vertical direction only (modes, stability).
    """
    d = 2 if planar or (planar is None and scene.lateral) else 1
    return _Builder(scene, mesh, d, top_elevation).model()


class _Builder:
    def __init__(self, scene: Scene, mesh: Mesh, d: int, top_elevation: float | None):
        self.scene, self.mesh, self.d = scene, mesh, d
        self.n = len(mesh.l0)
        self.g = scene.gravity or 0.0
        self.rho = scene.water.density if scene.water else 0.0
        self.effects: list[Effect] = []
        self.fixed: list[tuple[int, int]] = []
        self.parts = [stiffness(section) for section in scene.riser]
        self.m = 1 if d == 2 and all(part.bending > 0 for part in self.parts) else 0
        self.bottom_z = scene.bottom.elevation or 0.0
        if scene.bottom.hold == "free":
            self.bottom_z = (scene.top.elevation or 0.0) - float(mesh.l0.sum())
        self.top_z = top_elevation
        if self.top_z is None:
            self.top_z = scene.top.elevation

    def add(self, name: str, record: Any, because: str) -> None:
        self.effects.append(Effect(name, record, because))

    def per_segment(self, value: Any) -> FloatArray:
        """``value(section, k)`` of the section that each segment belongs to."""
        values = [float(value(section, k)) for k, section in enumerate(self.scene.riser)]
        return np.array(values)[self.mesh.section]

    def model(self) -> Model:
        self.motion()
        self.respond()
        self.supports()
        self.current()
        self.wave()
        self.string()
        self.ends()
        self.tensioners()
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
        )
        model.s.r[:] = self.guess()
        return model

    # what moves and holds

    def motion(self) -> None:
        platform = self.scene.platform
        if platform is None:
            return
        if platform.position:
            away = np.zeros(6)
            away[MOTION["surge"]] = platform.position.surge or 0.0
            away[MOTION["heave"]] = platform.position.heave or 0.0
            self.add("platform position", Position(away), "platform.position")
        rows = []
        for name in ("surge", "heave", "pitch"):
            motion = getattr(platform, name)
            if isinstance(motion, forcing.Harmonic):
                rows.append((name, motion))
            elif motion is not None:
                times = np.array([p.time for p in motion.points])
                values = np.array([p.value for p in motion.points])
                spline = CubicSpline(times, values)
                series = Series(MOTION[name], times, np.ascontiguousarray(spline.c))
                self.add("platform motion", series, f"platform.{name}")
        if rows:
            harmonic = Harmonic(
                np.array([MOTION[name] for name, _ in rows]),
                np.array([motion.amplitude for _, motion in rows]),
                np.array([2.0 * math.pi / motion.period for _, motion in rows]),
                np.array([motion.phase or 0.0 for _, motion in rows]),
                np.array([motion.ramp or 0.0 for _, motion in rows]),
            )
            names = ", ".join(f"platform.{name}" for name, _ in rows)
            self.add("platform motion", harmonic, names)
        if platform.cruise:
            cruise = platform.cruise
            record = Cruise(MOTION["surge"], cruise.speed, cruise.ramp or 0.0)
            self.add("platform motion", record, "platform.cruise")

    def respond(self) -> None:
        """Motion of the platform in the waves."""
        response = self.scene.platform and self.scene.platform.response
        if not response:
            return
        wave = response.wave or self.scene.wave
        if wave is None:
            raise TypeError("a response without wave")  # refused by the scene
        found = harmonics(response, wave)
        ramp = np.full(len(found.motion), response.ramp or 0.0)
        motion = np.array([MOTION[name] for name in found.motion])
        record = Harmonic(motion, found.amplitude, found.frequency, found.phase, ramp)
        self.add("platform motion", record, "platform.response")

    def hold(
        self, node: int, place: list[float], held: list[bool], follow: list[int], why: str
    ) -> None:
        """Hold a node in some of (x, z)."""
        use = slice(2 - self.d, 2)
        kept = np.array(held[use], np.int64)
        self.add(
            "support",
            Support(node, np.array(place[use]), kept, np.array(follow[use], np.int64)),
            why,
        )
        self.fixed += [(node, self.m + k) for k in range(self.d) if kept[k]]

    def supports(self) -> None:
        bottom, top = self.scene.bottom, self.scene.top
        if bottom.hold == "wellhead":
            self.hold(0, [0.0, self.bottom_z], [True, True], [-1, -1], "bottom.hold")
        held = [top.x not in (None, "free"), top.z != "free"]
        if any(held[2 - self.d :]):
            follow = [
                MOTION["surge"] if top.x == "platform" else -1,
                MOTION["heave"] if top.z == "platform" else -1,
            ]
            self.hold(self.n, [top.offset or 0.0, self.top_z or 0.0], held, follow, "top.x, top.z")
        if self.m:
            for node, end in ((0, bottom), (self.n, top)):
                if flexibility_of(end.rotation) is None:
                    self.fixed.append((node, 0))

    def current(self) -> None:
        current = self.scene.current
        if current is None or self.d == 1:
            return
        z, speed = current_table(current, self.scene.water)
        self.add("current", Current(z, speed, np.array([1.0]), current.ramp or 0.0), "current")

    def wave(self) -> None:
        sea, water = self.scene.wave, self.scene.water
        if sea is None or water is None or self.d == 1:
            return
        heading = sea.heading or 0.0
        along = np.array([math.cos(heading), math.sin(heading)])[: self.d - 1]
        self.add("wave", wave_of(sea, water, self.g, along), "wave")

    # the string

    def string(self) -> None:
        l0, rho = self.mesh.l0, self.rho
        sections = self.scene.riser
        self.add(
            "axial elasticity", Axial(self.per_segment(lambda s, k: self.parts[k].axial)), "riser"
        )
        relaxation = [
            d.ratio * d.at_period / math.pi if (d := s.structural_damping) else 0.0
            for s in sections
        ]
        if any(relaxation):
            damping = self.per_segment(lambda s, k: self.parts[k].axial * relaxation[k]) / l0
            self.add("axial damping", AxialDamping(damping), "riser.structural_damping")
        if self.m:
            self.bending(relaxation[0])
        weight = self.per_segment(
            lambda s, k: (
                (s.submerged_weight or 0.0)
                + (s.contents.density * self.parts[k].bore * self.g if s.contents else 0.0)
            )
        )
        if np.any(weight):
            self.add("weight", Weight(self.d - 1, halves(-weight * l0)), "riser.submerged_weight")
        load = self.per_segment(lambda s, k: s.lateral_load or 0.0)
        if np.any(load) and self.d > 1:
            self.add("line load", Weight(0, halves(load * l0)), "riser.lateral_load")
        mass = self.per_segment(lambda s, k: s.mass or 0.0) * l0
        if np.any(mass):
            self.add("inertia", Inertia(mass, -mass), "riser.mass")
        if self.d == 1:
            return
        inside = self.per_segment(
            lambda s, k: s.contents.density * self.parts[k].bore if s.contents else 0.0
        )
        if np.any(inside):
            self.add("contents", AddedMass(inside * l0, -inside * l0), "riser.contents")
        added = self.per_segment(
            lambda s, k: (
                s.added_mass.coefficient * 0.25 * math.pi * s.added_mass.diameter**2 * rho
                if s.added_mass
                else 0.0
            )
        )
        if np.any(added):
            self.add("added mass", AddedMass(added * l0, -added * l0), "riser.added_mass")
        displaced = self.per_segment(
            lambda s, k: 0.25 * math.pi * s.added_mass.diameter**2 * rho if s.added_mass else 0.0
        )
        if np.any(displaced) and self.scene.wave:
            mass = (displaced + added) * l0
            record = WaveForce(mass, np.zeros((self.d, self.n + 1)))
            self.add("wave force", record, "wave, riser.added_mass")
        drag = self.per_segment(
            lambda s, k: 0.5 * rho * s.drag.coefficient * s.drag.diameter if s.drag else 0.0
        )
        if np.any(drag):
            self.add("drag", Drag(drag * l0, np.zeros((self.d, self.n + 1))), "riser.drag")

    def bending(self, relaxation: float) -> None:
        flexibility = self.mesh.l0 / self.per_segment(lambda s, k: self.parts[k].bending)
        own, other = np.full(self.n, OWN), np.full(self.n, OTHER)
        bottom, top = self.scene.bottom, self.scene.top
        for segment, end in ((0, bottom), (-1, top)):
            if flexibility_of(end.rotation) is not None:
                own[segment], other[segment] = 1.0 / 3.0, 1.0 / 6.0
        flex = np.zeros(self.n + 1)
        flex[:-1] += own * flexibility
        flex[1:] += own * flexibility
        self.add(
            "bending",
            Bending(flex, other * flexibility),
            "riser.young_modulus or bending_stiffness",
        )
        axial = self.per_segment(lambda s, k: self.parts[k].axial)
        slope = axial * flexibility**2 / 72.0
        self.add(
            "foreshortening", Foreshortening(slope), "riser.young_modulus or bending_stiffness"
        )
        if relaxation:
            record = BendingDamping(relaxation, *np.zeros((2, self.n + 1)))
            self.add("bending damping", record, "riser.structural_damping")
        for node, end, name in ((0, bottom, "bottom"), (self.n, top, "top")):
            soft = flexibility_of(end.rotation)
            if soft is not None:
                follows = 1.0 if name == "top" and top.x == "platform" else 0.0
                label = "flex joint" if soft > 0.0 else "clamp"
                self.add(label, FlexJoint(node, soft, 0.0, follows), f"{name}.rotation")

    # what is attached

    def ends(self) -> None:
        bottom, top = self.scene.bottom, self.scene.top
        for node, end, name in ((0, bottom, "bottom"), (self.n, top, "top")):
            if end.body is None:
                continue
            body = end.body
            extra = body.added_mass or BodyAddedMass()
            area = body.drag_area or Areas()
            mass = np.full(self.d, body.mass)
            mass[-1] += extra.vertical or 0.0
            mass[:-1] += extra.horizontal or 0.0
            drag = 0.5 * self.rho * np.array([area.horizontal or 0.0, area.vertical or 0.0])
            record = EndMass(node, body.weight(self.g, self.rho), mass, drag)
            self.add("end mass", record, f"{name}.body")
        if top.tension:
            load = np.zeros(self.d)
            load[-1] = top.tension
            self.add("constant tension", Pull(self.n, load), "top.tension")
        if top.lateral_force and self.d > 1:
            self.add(
                "lateral force",
                Pull(self.n, np.array([top.lateral_force, 0.0])),
                "top.lateral_force",
            )

    def tensioners(self) -> None:
        rig = self.scene.top.tensioners
        if rig is None:
            return
        each = np.ones(rig.count)
        if rig.gas and not rig.linearised:
            gas = rig.gas
            record: Any = GasSpring(
                gas.area * each, gas.pressure * each, gas.volume * each, gas.exponent * each
            )
            self.add("gas tensioner", record, "top.tensioners.gas")
        elif rig.two_chamber_gas and not rig.linearised:
            both = rig.two_chamber_gas
            sides = (getattr(side, name) for side in (both.high, both.low) for name in GAS_FIELDS)
            weight = rig.piston_mass * self.g
            record = TwoChamberGas(*(x * each for x in (*sides, both.exponent, weight)))
            self.add("two-chamber gas tensioner", record, "top.tensioners.two_chamber_gas")
        else:
            tension, slope = linear_law(rig, self.g)
            why = "top.tensioners.linearised" if rig.any_gas else "top.tensioners.linear"
            self.add("linear tensioner", LinearSpring(tension * each, slope * each), why)
        if rig.piston_mass:
            mass = np.zeros(self.d)
            mass[-1] = rig.count * rig.piston_mass
            pistons = EndMass(self.n, 0.0, mass, np.zeros(2))
            self.add("piston mass", pistons, "top.tensioners.two_chamber_gas.pistons")
        if rig.damping:
            self.add(
                "tensioner damping", CylinderDamping(rig.damping * each), "top.tensioners.damping"
            )
        if rig.stroke:
            stop = rig.stroke
            record = EndStop(stop.shortest * each, stop.longest * each, stop.stop_stiffness * each)
            self.add("end stops", record, "top.tensioners.stroke")
        zero = self.bottom_z + float(self.mesh.l0.sum())
        if rig.mid_stroke == "riser in equilibrium" and self.top_z is not None:
            zero = self.top_z
        self.add("tensioner cylinders", Upright(self.n, zero * each), "top.tensioners")

    def guess(self) -> FloatArray:
        """Straight from end to end, or sagging where the riser is longer than that."""
        total = float(self.mesh.l0.sum())
        offset = (self.scene.top.offset or 0.0) if self.d > 1 else 0.0
        rise = total if self.top_z is None else self.top_z - self.bottom_z
        shape = np.stack([offset * self.mesh.s, rise * self.mesh.s]) / total
        if offset and math.hypot(offset, rise) < total:
            shape = sagging(self.mesh.s, offset, rise)
        shape[1] += self.bottom_z
        return shape[2 - self.d :]


def sagging(s: FloatArray, offset: float, rise: float) -> FloatArray:
    """Points at arclengths ``s`` of the parabola as long as the riser, (2, n+1)."""
    u = np.linspace(0.0, 1.0, 2001)

    def curve(sag: float) -> FloatArray:
        return np.stack([offset * u, rise * u - 4.0 * sag * u * (1.0 - u)])

    def arclength(sag: float) -> FloatArray:
        return np.append(0.0, np.hypot(*np.diff(curve(sag))).cumsum())

    sag = brentq(lambda h: arclength(h)[-1] - s[-1], 0.0, s[-1])
    return np.stack([np.interp(s, arclength(sag), row) for row in curve(sag)])


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
