r"""Bending of the pipe in a plane, exact for large rotations.

The angle by which the riser turns at node i follows from the moments around it,

.. math:: \alpha_i - \alpha_{i-1} = \sum_j A_{ij} M_j,\qquad
          A_{ii} = \sum_e \tfrac{5}{12}\,\ell_e/EI_e,\quad A_{i,i+1} = \tfrac{1}{12}\,\ell_i/EI_i,

where :math:`\alpha_e` is the angle of segment e from the vertical, towards +x. A segment whose end is
held in direction (clamp, flex joint) takes the shares 1/3 and 1/6 of linearly varying curvature instead.
Equilibrium of a segment makes its shear force the difference of the end moments over its length:

.. math:: Q_e = (M_e - M_{e+1}) / \ell_e .

The moments are unknowns of the solver, so no stiffness grows as :math:`EI/\ell^3`.
"""

from __future__ import annotations

from math import atan2
from typing import NamedTuple

import numpy as np

from riserstudy.effects.roles import register
from riserstudy.jit import inner
from riserstudy.solve.vec import mul, plus, plus_block


class Bending(NamedTuple):
    """Flexibility of the pipe."""

    flex: np.ndarray  # (n+1,) A_ii (rad/(N m))
    flex_up: np.ndarray  # (n,) A_i,i+1 (rad/(N m))


@inner
def angle_between(sine, cosine):
    """Angle from its sine and cosine; a series where that is exact to 1e-13 and twice as fast."""
    if cosine > 0.0 and -0.1 < sine < 0.1:
        q = sine * sine
        return sine * (
            1.0 + q * (1.0 / 6.0 + q * (3.0 / 40.0 + q * (5.0 / 112.0 + q * (35.0 / 1152.0))))
        )
    return atan2(sine, cosine)


@inner
def compliance(bending, s):
    """Enter the flexibility of the pipe."""
    s.flex[:] += bending.flex
    s.flex_up[:] += bending.flex_up
    return 0.0


@inner
def turn(bending, s):
    """By how much the turning angles miss the moments."""
    n = s.l0.shape[0]
    t, moment, missing, flex, flex_up = s.tangent, s.moment, s.turn, s.flex, s.flex_up
    missing[0, 0] -= flex[0] * moment[0, 0] + flex_up[0] * moment[0, 1]
    missing[0, n] -= flex[n] * moment[0, n] + flex_up[n - 1] * moment[0, n - 1]
    for i in range(1, n):
        sine = t[0, i] * t[1, i - 1] - t[1, i] * t[0, i - 1]
        cosine = t[0, i] * t[0, i - 1] + t[1, i] * t[1, i - 1]
        bent = flex_up[i - 1] * moment[0, i - 1] + flex[i] * moment[0, i]
        missing[0, i] += angle_between(sine, cosine) - bent - flex_up[i] * moment[0, i + 1]
    return 0.0


@inner
def force(bending, s):
    """Shear from the moments."""
    t, moment = s.tangent, s.moment
    for e in range(s.l0.shape[0]):
        shear = (moment[0, e] - moment[0, e + 1]) / s.length[e]
        plus(s.segment, e, (shear * t[1, e], -shear * t[0, e]))
    return 0.0


@inner
def tangent(bending, s):
    """How the segment angles follow the nodes, and shear the direction of the segment."""
    t, moment = s.tangent, s.moment
    for e in range(s.l0.shape[0]):
        x, z, length = t[0, e], t[1, e], s.length[e]
        s.lever[e, 0] += z / length
        s.lever[e, 1] -= x / length
        s.swing[e, 0] += z / length
        s.swing[e, 1] -= x / length
        twice = (moment[0, e] - moment[0, e + 1]) / (length * length)
        cross, square = -2.0 * x * z, x * x - z * z
        plus_block(s.k_segment, e, mul(twice, (cross, square, square, -cross)))
    return 0.0


@inner
def energy(bending, s):
    """Strain energy (J)."""
    moment = s.moment
    n = s.l0.shape[0]
    total = 0.5 * bending.flex[n] * moment[0, n] ** 2
    for i in range(n):
        total += 0.5 * bending.flex[i] * moment[0, i] ** 2
        total += bending.flex_up[i] * moment[0, i] * moment[0, i + 1]
    return total


register(Bending, compliance=compliance, turn=turn, string=force, tangent=tangent, potential=energy)
