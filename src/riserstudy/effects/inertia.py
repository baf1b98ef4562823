r"""Inertia of the riser's mass, equal in all directions.

.. math:: f = -m\,\ddot r

References
----------
Elementary: Newton's second law.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner
from riserstudy.solve.spread import spread
from riserstudy.solve.state import ACCELERATION
from riserstudy.solve.vec import at, dot


class Inertia(NamedTuple):
    """Mass of the segments."""

    mass: np.ndarray  # (n,) (kg)
    minus: np.ndarray  # (n,) the same, negative


@inner
def force(inertia, s):
    """Inertial force."""
    spread(s, inertia.minus, inertia.minus, s.share[0], s.share[1], s.a, s.force)
    return 0.0


@inner
def mass(inertia, s):
    """Mass times d a / d r."""
    d, n, mass = len(s.dim), s.l0.shape[0], inertia.mass
    own, other = s.rate[ACCELERATION] * s.share[0], s.rate[ACCELERATION] * s.share[1]
    for c in range(d):
        k = c * d + c
        s.k_node[0, k] += own * mass[0]
        s.k_node[n, k] += own * mass[n - 1]
        for i in range(1, n):
            s.k_node[i, k] += own * (mass[i - 1] + mass[i])
        if other == 0.0:
            continue
        for e in range(n):
            s.k_up[e, k] += other * mass[e]
            s.k_low[e, k] += other * mass[e]
    return 0.0


@inner
def lump(inertia, s):
    """Masses of the nodes."""
    d, n, mass, own = len(s.dim), s.l0.shape[0], inertia.mass, s.share[0]
    for c in range(d):
        k = c * d + c
        s.lump[k, 0] += own * mass[0]
        s.lump[k, n] += own * mass[n - 1]
        for i in range(1, n):
            s.lump[k, i] += own * (mass[i - 1] + mass[i])
    return 0.0


@inner
def energy(inertia, s):
    """Kinetic energy (J)."""
    own, other = s.share[0], s.share[1]
    total = 0.0
    for e in range(s.l0.shape[0]):
        low, up = at(s.dim, s.v, e), at(s.dim, s.v, e + 1)
        square = own * (dot(low, low) + dot(up, up)) + 2.0 * other * dot(low, up)
        total += 0.5 * inertia.mass[e] * square
    return total


register(Inertia, Called("inertia", "riser.mass"), string_inertia=force, mass=mass, lump=lump, kinetic=energy)
