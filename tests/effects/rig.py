"""Every effect with its case on a small riser, and how its derivatives are taken."""

from __future__ import annotations

import copy
from collections.abc import Callable
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

import each
import numpy as np
from surroundings import CYLINDERS, L0, MOMENTS, PROBES, TOP, Case, N, flexibility

from riserstudy.effects.cylinder_damping import CylinderDamping
from riserstudy.effects.end_stop import EndStop
from riserstudy.effects.flex_joint import FlexJoint
from riserstudy.effects.gas_spring import GasSpring
from riserstudy.effects.linear_spring import LinearSpring
from riserstudy.effects.tabulated_law import TabulatedLaw
from riserstudy.effects.two_chamber_gas import TwoChamberGas
from riserstudy.model.model import Effect, Model, Unknowns
from riserstudy.solve.evaluate import energies, forces_and_tangent, one_call, shape_of
from riserstudy.solve.state import State

FILES = [import_module(f"each.{module.name}") for module in iter_modules(each.__path__)]
CASES: dict[type, Case] = {kind: case for file in FILES for kind, case in file.CASES.items()}
#: role of the kernel function that each plain version stands for, and the version
PLAIN = {kind: roles for file in FILES for kind, roles in getattr(file, "PLAIN", {}).items()}
MOTIONS = {kind: path for file in FILES for kind, path in getattr(file, "MOTIONS", {}).items()}
PAIRS = [(kind, d) for kind, case in CASES.items() for d in case.directions]


def name(pair) -> str:
    return f"{pair[0].__name__}-{pair[1]}d"


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
        ends = [0] if kind is FlexJoint else [0, N]
        fixed = [(node, u) for node in ends for u in range(self.m)]
        unknowns = Unknowns(
            L0, d, self.m, cylinders=CYLINDERS, probes=PROBES, loose=case.loose, internal=case.internal
        )
        self.model = Model(unknowns, effects, fixed)
        self.s: State = self.model.s
        self.record = next(e.record for e in self.model.effects if type(e.record) is kind)
        stir(self.s, seed)
        self.s.moment[:, self.model.hinged] = 0.0
        self.place()

    def place(self) -> None:
        """What follows from the platform alone."""
        one_call(self.model.programs.value.place, self.model.state)

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
        self.place()
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
    if d == 2:
        s.platform[:, [1, 3, 5]] = 0.0  # sway, roll and yaw lead out of the plane
    s.clock[:] = 4.3, 0.8
    s.rate[:] = 0.0
    s.internal[:] = s.internal_known[:] = random.uniform(0.1, 2.0, s.internal.shape)
    s.internal_share[:] = 0.02


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
