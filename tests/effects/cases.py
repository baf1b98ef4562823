"""A small riser for each effect: uneven, bent, stretched, moving, in a sheared current."""

from __future__ import annotations

import copy
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from riserstudy.effects.added_mass import AddedMass
from riserstudy.effects.axial import Axial
from riserstudy.effects.axial_damping import AxialDamping
from riserstudy.effects.bending import Bending
from riserstudy.effects.bending_damping import BendingDamping
from riserstudy.effects.bending_damping_in_space import SpatialBendingDamping
from riserstudy.effects.bending_in_space import SpatialBending
from riserstudy.effects.current import Current
from riserstudy.effects.cylinder import Upright
from riserstudy.effects.cylinder_damping import CylinderDamping
from riserstudy.effects.cylinders_in_space import CylindersInSpace
from riserstudy.effects.dead_load import DeadLoad
from riserstudy.effects.drag import Drag
from riserstudy.effects.drag_over_depth import DragOverDepth
from riserstudy.effects.end_mass import EndMass
from riserstudy.effects.end_stop import EndStop
from riserstudy.effects.exchange import LentForce, ToldMotion
from riserstudy.effects.flex_joint import FlexJoint
from riserstudy.effects.flex_joint_in_space import SpatialFlexJoint
from riserstudy.effects.foreshortening import Foreshortening
from riserstudy.effects.gas_spring import GasSpring
from riserstudy.effects.inertia import Inertia
from riserstudy.effects.inner_flex_joint import InnerFlexJoint
from riserstudy.effects.linear_spring import LinearSpring
from riserstudy.effects.munk import Munk
from riserstudy.effects.platform_motion import Cruise, Harmonic, Position, Series
from riserstudy.effects.sliding_tension import SlidingTension
from riserstudy.effects.soil import LinearSoil, SoftClay
from riserstudy.effects.stress_gauge import StressGauge
from riserstudy.effects.support import Support
from riserstudy.effects.tabulated_law import TabulatedLaw
from riserstudy.effects.tangential_drag import TangentialDrag
from riserstudy.effects.tension_loss import TensionLoss
from riserstudy.effects.thrusters import Thrusters
from riserstudy.effects.torsion import Torsion
from riserstudy.effects.two_chamber_gas import TwoChamberGas
from riserstudy.effects.vessel import Vessel
from riserstudy.effects.waterline import Waterline
from riserstudy.effects.wave import CONSTANT, STRETCHED, Wave
from riserstudy.effects.wave_force import WaveForce
from riserstudy.effects.weight import Weight
from riserstudy.model.layout import AXES
from riserstudy.model.model import Effect, Model, Unknowns
from riserstudy.model.tensioner_law import table_law
from riserstudy.scene.tensioners import TableRow
from riserstudy.solve.evaluate import energies, forces_and_tangent, one_call, shape_of
from riserstudy.solve.state import OTHER, OWN, State

L0 = np.array([12.0, 9.0, 15.0, 11.0, 8.0, 14.0])
N = len(L0)
SEGMENTS = np.linspace(1.0, 1.5, N)  # what makes the segments differ
CYLINDERS = 2
PROBES = "abcd"  # beside those of the cylinders
TOP = 60.0  # elevation of the ring at mid-stroke (m)


class Case(NamedTuple):
    """One effect and what must stand beside it to act."""

    record: Callable[[int], Any]  # by number of directions
    beside: Callable[[int], list[Any]] = lambda d: []
    directions: tuple[int, ...] = (1, 2, 3)
    loose: int = 0  # nodes beyond the riser's


def bending(d: int) -> Bending | SpatialBending:
    flexibility = L0 / (2.7e8 * SEGMENTS)
    flex = np.zeros(N + 1)
    flex[:-1] += OWN * flexibility
    flex[1:] += OWN * flexibility
    return (Bending if d == 2 else SpatialBending)(flex, OTHER * flexibility)


def current(d: int) -> Current:
    heading = np.array([1.0] if d == 2 else [0.6, 0.8][: d - 1])
    elevation, speed = np.array([[-50.0, 20.0, 41.0, 75.0], [0.3, 1.0, 0.5, 1.7]])
    return Current(elevation, speed, heading, np.zeros(N + 1, np.int64), 8.0)


def depths(d: int) -> DragOverDepth:
    """Below the table, on a slope of it with a corner, across two jumps in one segment, and above it."""
    return DragOverDepth(
        *np.zeros((2, N)), np.zeros((d, N + 1)), 0, 6e3 * np.append(SEGMENTS[:-1], 0.0),
        np.array([4.0, 20.0, 22.0, 29.0, 29.0, 31.0, 31.0, 41.0]),
        np.array([0.9, 1.5, 0.6, 0.8, 1.3, 1.2, 0.5, 0.7]),
    )  # fmt: skip


def uniform(d: int) -> Current:
    heading = np.array([1.0, 0.0][: d - 1])
    near = np.zeros(N + 1, np.int64)
    return Current(np.array([0.0, 1.0]), np.array([0.7, 0.7]), heading, near, 0.0)


def wave(d: int, above: int = STRETCHED) -> Wave:
    heading = np.array([0.6, 0.8][: d - 1])
    return Wave(
        np.array([1.5, 2.0]), np.array([0.8, 0.5]), np.array([0.07, 0.03]), np.array([0.3, -1.0]),
        heading, 45.0, 60.0, 9.0, above,
    )  # fmt: skip


def upright(d: int) -> Upright:
    return Upright(N, TOP + np.array([0.0, 0.5]))


def pair(a: float, b: float) -> np.ndarray:
    return np.array([a, b])


def tabulated(d: int) -> TabulatedLaw:
    table = [(-9.0, 6e5), (-4.0, 7e5), (-1.5, 7e5), (0.5, 7.4e5), (3.0, 9e5), (9.0, 9.3e5)]
    law = table_law([TableRow.model_construct(reach=x, force=f) for x, f in table])
    return TabulatedLaw(law.x, law.c, law.antiderivative().c, pair(1.0, 0.5))


def series(d: int) -> Series:
    coefficient = np.random.default_rng(3).normal(size=(4, 5)) * [[1e-3], [1e-2], [0.1], [1.0]]
    return Series(2, np.array([0.0, 2.0, 3.0, 5.5, 8.0, 10.0]), coefficient)


def stirred(*shape: int) -> np.ndarray:
    return np.random.default_rng(4).normal(size=shape)


def vessel(d: int) -> Vessel:
    """In the plane it keeps its heading."""
    yaw = N + 1 if d == 3 else 0
    return Vessel(
        *(N, yaw, 50.0, 0.4 if d == 3 else 0.0, pair(5e7, 8e7), 6e7, pair(2.5e5, 9e5), 3e5),
        *(pair(0.5, 0.3), 2e3, pair(-9.0, 4.0), pair(1e5, -6e4), 0),
    )


def thrusters(d: int) -> Thrusters:
    """Limited in space; their lag is that of a mass small enough for the tangent to show it."""
    gain, damping = np.array([[6.5e4, 1e4], [1e4, 9e4]]), np.array([[1e6, 1e5], [1e5, 2e6]])
    saturation = 1e6 if d == 3 else np.inf
    return Thrusters(
        N, 0, d - 1, gain, damping, pair(100.0, 30.0), 7.0, saturation, 4.0, 30.0, 1.0, 0
    )


CASES = {
    Axial: Case(lambda d: Axial(8e8 * SEGMENTS)),
    AxialDamping: Case(lambda d: AxialDamping(3e6 * SEGMENTS)),
    Weight: Case(lambda d: Weight(d - 1, -1e4 * np.linspace(1.0, 2.0, N + 1))),
    Inertia: Case(lambda d: Inertia(9e3 * SEGMENTS, -9e3 * SEGMENTS)),
    AddedMass: Case(lambda d: AddedMass(7e3 * SEGMENTS, -7e3 * SEGMENTS, 0)),
    Drag: Case(
        lambda d: Drag(6e3 * SEGMENTS, 5e3 * SEGMENTS, np.zeros((d, N + 1)), 0),
        lambda d: [current(d)],
    ),
    DragOverDepth: Case(depths, lambda d: [current(d)]),
    TangentialDrag: Case(
        lambda d: TangentialDrag(2e4 * SEGMENTS), lambda d: [current(d)] if d > 1 else []
    ),
    Current: Case(current),
    Wave: Case(wave),
    WaveForce: Case(
        lambda d: WaveForce(8e3 * SEGMENTS, np.zeros((d, N + 1))), lambda d: [wave(d, CONSTANT)]
    ),
    Bending: Case(bending, directions=(2,)),
    BendingDamping: Case(
        lambda d: BendingDamping(0.4, *np.zeros((2, N + 1))),
        lambda d: [bending(d)],
        (2,),
    ),
    SpatialBending: Case(bending, directions=(3,)),
    SpatialBendingDamping: Case(
        lambda d: SpatialBendingDamping(0.4, *np.zeros((2, 3, N + 1))),
        lambda d: [bending(d)],
        (3,),
    ),
    Foreshortening: Case(
        lambda d: Foreshortening(8e9 * (L0 / 2.7e8) ** 2 / 72.0), lambda d: [bending(d)], (2, 3)
    ),
    SpatialFlexJoint: Case(
        lambda d: SpatialFlexJoint(
            N, 1e-7, np.array([0.06, -0.08, np.sqrt(0.99)]), 1, np.zeros((3, 3))
        ),
        lambda d: [bending(d)],
        (3,),
    ),
    CylindersInSpace: Case(
        lambda d: CylindersInSpace(
            node=N - 1,
            centre=np.array([0.5, -0.2, 55.0]),
            deck=np.array([[2.0, -2.5], [0.3, -0.4], [8.0, 9.0]]),
            ring=np.zeros((3, 2)),  # the moment's derivative is left out, as its file says
            length=pair(11.0, 12.0),
            below=np.zeros(2),
            above=np.zeros(2),
            work=np.zeros((3, 3)),
        ),
        lambda d: [LinearSpring(pair(8e5, 7e5), pair(3e4, 2e4))],
    ),
    FlexJoint: Case(lambda d: FlexJoint(N, 1e-7, 0.05, 1.0), lambda d: [bending(d)], (2,)),
    Upright: Case(upright),
    GasSpring: Case(
        lambda d: GasSpring(pair(0.17, 0.16), pair(190e5, 180e5), pair(3.2, 3.0), pair(1.4, 1.2)),
        lambda d: [upright(d)],
    ),
    TwoChamberGas: Case(
        lambda d: TwoChamberGas(
            *(pair(0.20, 0.21), pair(20e5, 21e5), pair(9.4, 9.0)),
            *(pair(0.25, 0.24), pair(1.5e5, 1.4e5), pair(2.2, 2.3)),
            *(pair(1.4, 1.2), pair(9.9e3, 5.9e4)),
        ),
        lambda d: [upright(d)],
    ),
    TabulatedLaw: Case(tabulated, lambda d: [upright(d)]),
    LinearSpring: Case(
        lambda d: LinearSpring(pair(8e5, 7e5), pair(3e4, 2e4)), lambda d: [upright(d)]
    ),
    CylinderDamping: Case(lambda d: CylinderDamping(pair(967.0, 2e4)), lambda d: [upright(d)]),
    EndStop: Case(
        lambda d: EndStop(pair(-0.1, 0.2), pair(0.1, 0.3), pair(1e7, 2e7)), lambda d: [upright(d)]
    ),
    EndMass: Case(
        lambda d: EndMass(0, 1.2e6, 1.4e5 * np.linspace(1.1, 1.0, d), pair(3e3, 7e3)),
        lambda d: [uniform(d)],
    ),
    InnerFlexJoint: Case(lambda d: InnerFlexJoint(3, 2e-7, 0), lambda d: [bending(d)], (2, 3)),
    SlidingTension: Case(lambda d: SlidingTension(N - 1, 2e6, L0[-1] - 1.0, 3e6)),
    # from the straight line over the curve to the ultimate resistance
    SoftClay: Case(
        lambda d: SoftClay(
            np.arange(5), 1e6 * np.linspace(1.0, 2.0, 5), np.array([9.0, 2.0, 1.0, 0.8, 0.9]), 0.1
        ),
        directions=(2, 3),
    ),
    LinearSoil: Case(
        lambda d: LinearSoil(np.arange(4), 1e6 * np.linspace(1.0, 2.0, 4)), directions=(2, 3)
    ),
    StressGauge: Case(lambda d: StressGauge(1, 4, 0.05, 120.0, 0), lambda d: [bending(d)], (2, 3)),
    Vessel: Case(vessel, directions=(2, 3), loose=1),
    Munk: Case(lambda d: Munk(N, N + 1, 50.0, 0.4, -3e7, pair(0.5, 0.3)), directions=(3,), loose=1),
    Thrusters: Case(thrusters, directions=(2, 3), loose=1),
    LentForce: Case(
        lambda d: LentForce(
            2, np.array([0.0, 3.0, 5.5, 8.0]), 1e5 * stirred(4, d - 1), 2 * CYLINDERS
        ),
        directions=(2, 3),
    ),
    ToldMotion: Case(
        lambda d: ToldMotion(N, np.array([0.0, 3.0, 5.5, 8.0]), stirred(3, 4, d - 1)),
        directions=(2, 3),
    ),
    Torsion: Case(lambda d: Torsion(N + 1, 2e5), directions=(3,), loose=1),
    Waterline: Case(
        lambda d: Waterline(45.0, np.ones((3, N)), np.ones(N), *np.ones((4, N))),
        lambda d: [wave(d, CONSTANT)] if d > 1 else [],
    ),
    DeadLoad: Case(lambda d: DeadLoad(2, np.linspace(3e5, 2e6, d))),
    TensionLoss: Case(lambda d: TensionLoss(2, -np.linspace(3e5, 2e6, d), 2.0, 4.5)),
    Support: Case(
        lambda d: Support(
            N,
            np.array([1.0, -2.0, TOP]),
            np.array(AXES[d]),
            np.ones(d, np.int64),
            np.ones(d, np.int64),
            np.array([3.0, -1.0, 20.0]),
            np.zeros((3, 3)),
        )
    ),
    Position: Case(lambda d: Position(np.linspace(0.1, 0.6, 6))),
    Harmonic: Case(
        lambda d: Harmonic(
            np.array([0, 2, 0]),
            np.array([2.0, 1.0, 0.5]),
            np.array([0.4, 0.6, 1.1]),
            np.array([0.3, 0.0, -1.0]),
            np.array([15.0, 0.0, 3.0]),
        )
    ),
    Cruise: Case(lambda d: Cruise(0, 1.5, 12.0)),
    Series: Case(series),
}

PAIRS = [(kind, d) for kind, case in CASES.items() for d in case.directions]


def name(pair) -> str:
    return f"{pair[0].__name__}-{pair[1]}d"


MOMENTS = {1: 0, 2: 1, 3: 3}  # by directions, as in risers that bend, whose kernels are compiled


class Rig:
    """A model with one effect (and what stands beside it), stirred; record and arrays at hand."""

    def __init__(self, kind: type, d: int, seed: int = 1, **changes: Any):
        case = CASES[kind]
        self.kind, self.d, self.m = kind, d, MOMENTS[d]
        records = [*case.beside(d), case.record(d)._replace(**changes)]
        if kind in (GasSpring, TwoChamberGas, LinearSpring, TabulatedLaw, CylinderDamping, EndStop):
            records.reverse()  # laws before the cylinder that sums them up, as a scene has them
        effects = [Effect(type(r).__name__, r, "") for r in records]
        # an end carries no moment where nothing holds its direction
        ends = [0] if kind in (FlexJoint, SpatialFlexJoint) else [0, N]
        fixed = [(node, u) for node in ends for u in range(self.m)]
        unknowns = Unknowns(L0, d, self.m, cylinders=CYLINDERS, probes=PROBES, loose=case.loose)
        self.model = Model(unknowns, effects, fixed)
        self.s: State = self.model.s
        self.record = next(e.record for e in self.model.effects if type(e.record) is kind)
        stir(self.s, seed)
        self.s.moment[:, self.model.hinged] = 0.0

    def frozen_record(self):
        kinds = [type(e.record) for e in self.model.effects]
        return self.model.records[kinds.index(self.kind)]

    def evaluate(self) -> np.ndarray:
        """(m + d, n+1): what moments miss, then forces; the tangent is filled in too."""
        forces_and_tangent(self.model.programs, self.model.state)
        return np.concatenate([self.s.turn, self.s.force]).copy()

    def inertial_forces(self) -> np.ndarray:
        programs = self.model.programs.value
        shape_of(self.model.programs, self.model.state)
        self.s.force[:] = 0.0
        one_call(programs.string_inertia, self.model.state)
        one_call(programs.device_inertia, self.model.state)
        return self.s.force.copy()

    def settle_moments(self) -> None:
        """Moments that belong to the shape and its rate."""
        s = self.s
        s.moment[:] = 0.0
        if not s.flex.any():
            return
        carried = ~self.model.hinged
        shape_of(self.model.programs, self.model.state)
        matrix = flexibility(s)[np.ix_(carried, carried)]
        s.moment[:, carried] = np.linalg.solve(matrix, s.turn[:, carried].T).T
        shape_of(self.model.programs, self.model.state)

    def potential(self) -> float:
        self.settle_moments()
        shape_of(self.model.programs, self.model.state)
        return float(energies(self.model.programs, self.model.state)[0])

    def kinetic(self) -> float:
        shape_of(self.model.programs, self.model.state)
        return float(energies(self.model.programs, self.model.state)[1])

    def flow(self) -> tuple[float, float]:
        """Power dissipated and supplied; after ``evaluate``."""
        self.s.flow[:] = 0.0
        one_call(self.model.programs.value.power, self.model.state)
        return float(self.s.flow[0]), float(self.s.flow[1])


def stir(s: State, seed: int) -> None:
    """A state with nothing zero: an arc with noise, in motion, at a time within the ramps."""
    random = np.random.default_rng(seed)
    d = len(s.dim)
    place = np.append(0.0, np.cumsum(s.l0 * (1.0 + 3e-3 * random.uniform(-1.0, 1.0, len(s.l0)))))
    if d == 1:
        s.r[0, : N + 1] = place
    else:  # an arc over half a radian
        radius = place[-1] / 0.5
        arc = radius * np.array([1.0 - np.cos(place / radius), np.sin(place / radius)])
        s.r[0, : N + 1], s.r[-1, : N + 1] = arc
        if d == 3:
            s.r[1, : N + 1] = 0.3 * arc[0]
        s.r[:] += 0.05 * random.normal(size=s.r.shape)
    s.r[-1, : N + 1] += TOP - s.r[-1, N]
    s.v[:] = random.normal(size=s.v.shape)
    s.a[:] = random.normal(size=s.a.shape)
    s.moment[:] = 1e5 * random.normal(size=s.moment.shape)
    s.platform[:] = 0.3 * random.normal(size=s.platform.shape)
    s.clock[:] = 4.3, 0.8
    s.rate[:] = 0.0


def flexibility(s: State) -> np.ndarray:
    return np.diag(s.flex) + np.diag(s.flex_up, 1) + np.diag(s.flex_up, -1)


def nodes(segment: np.ndarray) -> np.ndarray:
    """What segments do to their nodes: plus at the lower, minus at the upper."""
    out = np.zeros((segment.shape[0], segment.shape[1] + 1))
    out[:, :-1] += segment
    out[:, 1:] -= segment
    return out


def dense_tangent(s: State) -> np.ndarray:
    """Minus the derivative of (turn, force) by (moment, position), unknowns ordered as in arrays."""
    d, m, n = len(s.dim), len(s.dof) - len(s.dim), s.r.shape[1] - 1
    full = np.zeros((m + d, n + 1, m + d, n + 1))
    for p in range(d):
        for q in range(d):
            c = p * d + q
            for i in range(n + 1):
                full[m + p, i, m + q, i] += s.k_node[i, c]
            for e in range(n):
                low, up = (m + p, e), (m + p, e + 1)
                full[*low, m + q, e] += s.k_segment[e, c]
                full[*up, m + q, e + 1] += s.k_segment[e, c]
                full[*low, m + q, e + 1] += s.k_up[e, c] - s.k_segment[e, c]
                full[*up, m + q, e] += s.k_low[e, c] - s.k_segment[e, c]
    for u in range(m):
        full[u, :, u, :] = flexibility(s)
        for e in range(n):
            for p in range(d):
                c = p * m + u
                for node, sign in ((e, 1.0), (e + 1, -1.0)):
                    full[m + p, node, u, e] -= sign * s.by_low[e, c]
                    full[m + p, node, u, e + 1] -= sign * s.by_up[e, c]
                for node, by in ((e, s.turn_low[e, c]), (e + 1, s.turn_up[e, c])):
                    full[u, node, m + p, e + 1] -= by
                    full[u, node, m + p, e] += by
    size = (m + d) * (n + 1)
    return full.reshape(size, size)


def differences(function: Callable[[], np.ndarray], array: np.ndarray, step: float) -> np.ndarray:
    """Derivative of a function by every entry of an array it reads, fourth order; (out, in)."""
    columns = []
    for index in np.ndindex(array.shape):
        kept = array[index]
        values = []
        for k in (-2, -1, 1, 2):
            array[index] = kept + k * step
            values.append(np.asarray(function()).ravel().copy())
        array[index] = kept
        columns.append((values[0] - 8.0 * values[1] + 8.0 * values[2] - values[3]) / (12.0 * step))
    return np.array(columns).T


def copied(record: Any) -> Any:
    """A record or state with arrays of its own."""
    return copy.deepcopy(record)
