"""One evaluation of a model: motion, forces, inertia and stiffness of its effects."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.solve.blocktri import factor_flexibility, flexibility_solve
from riserstudy.solve.jit import inner, kernel
from riserstudy.solve.program import call_all
from riserstudy.solve.state import (
    ACCELERATION,
    clear,
    clear_forces,
    clear_tangent,
    gather,
    keep_ends,
    measure,
)


class Programs(NamedTuple):
    """Functions of a model's effects by role, each role an int64 array (calls, 2) of addresses."""

    motion: np.ndarray  # move the platform
    place: np.ndarray  # put held nodes in place
    drive: np.ndarray  # water velocities, cylinder reach
    internal: np.ndarray  # solve q = known + share G(q) for internal variables of an effect
    law: np.ndarray  # pulls of the cylinders by reach
    turn: np.ndarray  # residual of turning angles and moments
    string: np.ndarray  # forces on the riser string itself
    device: np.ndarray  # forces of bodies and devices attached to the string
    tangent: np.ndarray
    compliance: np.ndarray  # flexibility, constant
    string_inertia: np.ndarray
    device_inertia: np.ndarray
    mass: np.ndarray  # into the stiffness, times the rate
    lump: np.ndarray  # masses of the nodes, if no mass is shared between nodes
    potential: np.ndarray  # return energies
    kinetic: np.ndarray
    power: np.ndarray  # add to s.flow
    probe: np.ndarray  # fill s.probe


@inner
def move(p, s, time):
    """Set platform and held nodes to their positions at a time."""
    s.clock[0] = time
    for k in range(3):
        for c in range(6):
            s.platform[k, c] = 0.0
    call_all(p.motion, s)
    call_all(p.place, s)


@inner
def shape(p, s):
    """Compute directions, water motion, reach and turning angles from positions and velocities."""
    clear_forces(s)
    if p.drive.shape[0] > 0:  # otherwise these arrays are always zero
        clear(s.seas)
    measure(s)
    call_all(p.drive, s)
    call_all(p.internal, s)
    call_all(p.law, s)
    call_all(p.turn, s)


@inner
def load(p, s):
    """Write forces without inertia to ``s.force``, the string's end forces to ``s.ends``; after `shape`."""
    call_all(p.string, s)
    gather(s)
    keep_ends(s, s.ends[0])
    call_all(p.device, s)


@inner
def forces(p, s):
    """Write all forces except inertia to ``s.force``, and residuals of the turning angles to ``s.turn``."""
    shape(p, s)
    load(p, s)


@inner
def inertia(p, s):
    """Write inertial forces alone to ``s.force``; the directions of segments must be known."""
    s.force[:] = 0.0
    call_all(p.string_inertia, s)
    keep_ends(s, s.ends[1])
    call_all(p.device_inertia, s)


@inner
def tangent(p, s):
    """Stiffness, with damping and mass at the rates ``s.rate``; after ``forces``."""
    clear_tangent(s)
    call_all(p.tangent, s)
    if s.rate[ACCELERATION] > 0.0:
        call_all(p.mass, s)


@inner
def true_moments(s):
    """Correct the moments to those of the shape; after ``shape``, whose turning angles it overwrites."""
    m, n = len(s.dof) - len(s.dim), s.l0.shape[0]
    for u in range(m):
        flexibility_solve(s, s.turn[u])
        for i in range(n + 1):
            s.moment[u, i] += s.turn[u, i]


@kernel
def set_compliance(p, s, hinged):
    """Compute the flexibility of pipe and joints, once for a model."""
    s.flex[:] = 0.0
    s.flex_up[:] = 0.0
    call_all(p.compliance, s)
    factor_flexibility(s, hinged)


@kernel
def move_to(p, s, time):
    """`move` for callers in Python."""
    move(p, s, time)


@kernel
def forces_and_tangent(p, s):
    """`forces` and `tangent` for callers in Python."""
    forces(p, s)
    tangent(p, s)


@kernel
def energies(p, s):
    """Potential and kinetic energy (J) of the present positions and velocities."""
    shape(p, s)
    return call_all(p.potential, s), call_all(p.kinetic, s)


@kernel
def one_call(program, s):
    """Run a program on a state, for callers in Python."""
    return call_all(program, s)


@kernel
def shape_of(p, s):
    """`shape` for callers in Python."""
    shape(p, s)


@kernel
def force_of(program, s):
    """Forces of a few effects alone, after `shape`."""
    call_all(program, s)
    gather(s)
