r"""Bending of the pipe in space, exact for large rotations; torsion is free.

The rotation vector that turns the direction of one segment into the direction of the next segment follows
from the moments,

.. math:: \theta_i = \frac{\varphi}{\sin\varphi}\; t_{i-1} \times t_i = \sum_j A_{ij} M_j,

Here :math:`\varphi` is the angle between the directions :math:`t_{i-1}` and :math:`t_i` of both segments. A
is the flexibility of the effect `bending`, which is equal in all directions. By the equilibrium of a segment,
its shear force is :math:`Q_e = t_e \times (M_{e+1} - M_e) / \ell_e`. In a plane, both equations reduce to the
equations of the effect `bending`.

References
----------
Elementary: Euler and Bernoulli's beam, with Euler's theorem for the rotation between two directions.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.bending import compliance
from riserstudy.effects.registry import register
from riserstudy.effects.rotation import by_chord, rotation, rotation_by_first, rotation_by_second
from riserstudy.solve.jit import inner
from riserstudy.solve.vec import add, at, cross, dot, mul, outer, plus, plus_block, skew, sub


class SpatialBending(NamedTuple):
    """Flexibility of the pipe."""

    flex: np.ndarray  # (n+1,) A_ii (rad/(N m))
    flex_up: np.ndarray  # (n,) A_i,i+1 (rad/(N m))


@inner
def turn(bending, s):
    """Residual of the rotations: their difference from the rotations that follow from the moments."""
    n = s.l0.shape[0]
    moment, missing = s.moment, s.turn
    for i in range(n + 1):
        if 0 < i < n:
            plus(missing, i, rotation(at(s.dim, s.tangent, i - 1), at(s.dim, s.tangent, i)))
        bent = mul(s.flex[i], at(s.dim, moment, i))
        if i > 0:
            bent = add(bent, mul(s.flex_up[i - 1], at(s.dim, moment, i - 1)))
        if i < n:
            bent = add(bent, mul(s.flex_up[i], at(s.dim, moment, i + 1)))
        plus(missing, i, mul(-1.0, bent))
    return 0.0


@inner
def force(bending, s):
    """Shear from the moments."""
    for e in range(s.l0.shape[0]):
        rise = sub(at(s.dim, s.moment, e + 1), at(s.dim, s.moment, e))
        shear = cross(at(s.dim, s.tangent, e), rise)
        plus(s.segment, e, mul(s.inverse_length[e], shear))
    return 0.0


@inner
def tangent(bending, s):
    """Derivative of rotations and shear by node positions."""
    n = s.l0.shape[0]
    for e in range(n):
        t, inverse = at(s.dim, s.tangent, e), s.inverse_length[e]
        arm = mul(inverse, skew(t))
        plus_block(s.by_low, e, mul(-1.0, arm))
        plus_block(s.by_up, e, arm)
        rise = sub(at(s.dim, s.moment, e + 1), at(s.dim, s.moment, e))
        shear = cross(t, rise)
        turned = add(skew(rise), mul(2.0, outer(shear, t)))
        plus_block(s.k_segment, e, mul(-inverse * inverse, turned))
        if e > 0:
            before = at(s.dim, s.tangent, e - 1)
            plus_block(s.turn_low, e, by_chord(s, e, rotation_by_second(before, t)))
        if e < n - 1:
            after = at(s.dim, s.tangent, e + 1)
            plus_block(s.turn_up, e, by_chord(s, e, rotation_by_first(t, after)))
    return 0.0


@inner
def energy(bending, s):
    """Strain energy (J)."""
    n = s.l0.shape[0]
    total = 0.0
    for i in range(n + 1):
        here = at(s.dim, s.moment, i)
        total += 0.5 * bending.flex[i] * dot(here, here)
        if i < n:
            total += bending.flex_up[i] * dot(here, at(s.dim, s.moment, i + 1))
    return total


register(
    SpatialBending,
    "bending",
    compliance=compliance,
    turn=turn,
    string=force,
    tangent=tangent,
    potential=energy,
)
