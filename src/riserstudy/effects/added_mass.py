r"""Mass that resists acceleration across the pipe only: added mass of the water, and contents.

.. math:: f = -m_n\,(\ddot r - (\ddot r \cdot t)\,t),\qquad m_a = C_a \rho\,\pi D^2/4

Here t is the direction of the pipe, and :math:`m_n` is the sum of the added mass :math:`m_a` of the water
outside the pipe, by the Morison equation, and of the mass of a fluid inside the pipe. The fluid inside the
pipe follows the lateral motion of the pipe, but not its axial motion. If the added mass acts horizontally, t
is the vertical direction instead.

References
----------
Morison, O'Brien, Johnson and Schaaf (1950), "The force exerted by surface waves on piles", *Petroleum
Transactions AIME* 189, 149-154: its inertia term.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, put_in, register, taken_out
from riserstudy.solve.jit import inner
from riserstudy.solve.spread import spread, spread_stiffness
from riserstudy.solve.state import ACCELERATION, axis
from riserstudy.solve.vec import at, dot, mul, outer, plus_upper, put, put_block, sub, unity


class AddedMass(NamedTuple):
    """Mass that acts across the pipe."""

    mass: np.ndarray  # (n,) of the segments (kg)
    minus: np.ndarray  # (n,) the same, negative
    horizontal: int  # 1: acts horizontally, 0: acts across the pipe


@inner
def force(added, s):
    """Inertial force of the acceleration across the pipe."""
    for i in range(s.l0.shape[0] + 1):
        a, t = at(s.dim, s.a, i), axis(s, added.horizontal, i)
        put(s.density, i, sub(a, mul(dot(a, t), t)))
    spread(s, added.minus, added.minus, s.share[0], s.share[1], s.density, s.force)
    return 0.0


@inner
def mass(added, s):
    """Mass times d a / d r, across the pipe."""
    unit = unity(s.dim)
    for i in range(s.l0.shape[0] + 1):
        t = axis(s, added.horizontal, i)
        put_block(s.block, i, mul(s.rate[ACCELERATION], sub(unit, outer(t, t))))
    spread_stiffness(s, added.mass, added.mass, s.share[0], s.share[1])
    return 0.0


@inner
def lump(added, s):
    """Masses of the nodes, across the pipe."""
    n, mass, own = s.l0.shape[0], added.mass, s.share[0]
    _lump_at(added, s, 0, own * mass[0])
    _lump_at(added, s, n, own * mass[n - 1])
    for i in range(1, n):
        _lump_at(added, s, i, own * (mass[i - 1] + mass[i]))
    return 0.0


@inner
def _lump_at(added, s, i, mass):
    t = axis(s, added.horizontal, i)
    plus_upper(s.lump, i, mul(mass, sub(unity(s.dim), outer(t, t))))


@inner
def energy(added, s):
    """Kinetic energy of the water carried along (J)."""
    own, other = s.share[0], s.share[1]
    for i in range(s.l0.shape[0] + 1):
        v, t = at(s.dim, s.v, i), axis(s, added.horizontal, i)
        put(s.density, i, sub(v, mul(dot(v, t), t)))
    total = 0.0
    for e in range(s.l0.shape[0]):
        low, up = at(s.dim, s.density, e), at(s.dim, s.density, e + 1)
        square = own * (dot(low, low) + dot(up, up)) + 2.0 * other * dot(low, up)
        total += 0.5 * added.mass[e] * square
    return total


register(
    AddedMass,
    Called(
        "contents", "riser.contents", (taken_out("contents", "riser[*].contents", "lateral"),), lateral=True
    ),
    Called(
        "added mass",
        "riser.added_mass",
        (
            taken_out("added mass", "riser[*].added_mass", "dynamics"),
            put_in(
                "added mass",
                "riser[*].added_mass",
                {
                    "riser[*].added_mass": {"coefficient": 1.0, "diameter": "=outer diameter"},
                    "water.density": "=water",
                },
                "coefficient 1 on the outer diameter, in sea water",
                "dynamics",
                "lateral",
            ),
        ),
        lateral=True,
    ),
    string_inertia=force,
    mass=mass,
    lump=lump,
    kinetic=energy,
)
