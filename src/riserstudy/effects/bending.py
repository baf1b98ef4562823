r"""Bending of the pipe in a plane, exact for large rotations.

The angle by which the riser turns at node i follows from the moments at this node and at the two neighbouring
nodes,

.. math:: \alpha_i - \alpha_{i-1} = \sum_j A_{ij} M_j,\qquad
          A_{ii} = \sum_e \tfrac{5}{12}\,\ell_e/EI_e,\quad A_{i,i+1} = \tfrac{1}{12}\,\ell_i/EI_i,

Here :math:`\alpha_e` is the angle of segment e from the vertical, towards +x. In a segment at a riser end
whose direction is held (clamp, flex joint), the factors are 1/3 and 1/6 instead of 5/12 and 1/12. The factors
1/3 and 1/6 correspond to a linearly varying curvature. By the equilibrium of a segment, the shear force is
the difference of the end moments divided by the length:

.. math:: Q_e = (M_e - M_{e+1}) / \ell_e .

The moments are unknowns of the solver, so no stiffness grows as :math:`EI/\ell^3`.

References
----------
Elementary: Euler and Bernoulli's beam, M = EI times curvature. The factors 1/3 and 1/6 are from Clapeyron's
theorem of three moments (1857). The factors 5/12 and 1/12 are exact for a parabola: page on theory, equations
(2) to (5).
"""

from __future__ import annotations

from math import atan2
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register, taken_out
from riserstudy.solve.jit import inner
from riserstudy.solve.vec import mul, plus, plus_block


class Bending(NamedTuple):
    """Flexibility of the pipe."""

    flex: np.ndarray  # (n+1,) A_ii (rad/(N m))
    flex_up: np.ndarray  # (n,) A_i,i+1 (rad/(N m))


@inner
def twice_arctan(half):
    """2 arctan for |half| < 0.05, exact to 1e-15."""
    q = half * half
    return 2.0 * half * (1.0 - q * (1 / 3 - q * (1 / 5 - q * (1 / 7 - q * (1 / 9 - q / 11)))))


@inner
def compliance(bending, s):
    """Add the flexibility of the pipe."""
    for i in range(bending.flex.shape[0]):
        s.flex[i] += bending.flex[i]
    for e in range(bending.flex_up.shape[0]):
        s.flex_up[e] += bending.flex_up[e]
    return 0.0


@inner
def turn(bending, s):
    """Residual of the turning angles: their difference from the angles that follow from the moments."""
    n = s.l0.shape[0]
    t, moment, missing, flex, flex_up = s.tangent, s.moment, s.turn, s.flex, s.flex_up
    missing[0, 0] -= flex[0] * moment[0, 0] + flex_up[0] * moment[0, 1]
    missing[0, n] -= flex[n] * moment[0, n] + flex_up[n - 1] * moment[0, n - 1]
    squares = 0.0
    for i in range(1, n):  # half angles by their tangent, small ones without a branch
        sine = t[0, i] * t[1, i - 1] - t[1, i] * t[0, i - 1]
        half = sine / (1.0 + t[0, i] * t[0, i - 1] + t[1, i] * t[1, i - 1])
        squares += half * half
        bent = flex_up[i - 1] * moment[0, i - 1] + flex[i] * moment[0, i]
        missing[0, i] += twice_arctan(half) - bent - flex_up[i] * moment[0, i + 1]
    if not squares < 0.05**2:
        for i in range(1, n):
            sine = t[0, i] * t[1, i - 1] - t[1, i] * t[0, i - 1]
            cosine = t[0, i] * t[0, i - 1] + t[1, i] * t[1, i - 1]
            missing[0, i] += atan2(sine, cosine) - twice_arctan(sine / (1.0 + cosine))
    return 0.0


@inner
def force(bending, s):
    """Shear from the moments."""
    t, moment = s.tangent, s.moment
    for e in range(s.l0.shape[0]):
        shear = (moment[0, e] - moment[0, e + 1]) * s.inverse_length[e]
        plus(s.segment, e, (shear * t[1, e], -shear * t[0, e]))
    return 0.0


@inner
def tangent(bending, s):
    """Derivative of the turning angles by node positions, and of the shear by the segment's direction."""
    n = s.l0.shape[0]
    t, moment = s.tangent, s.moment
    for i in range(1, n):
        s.turn_low[i, 0] += t[1, i] * s.inverse_length[i]
        s.turn_low[i, 1] -= t[0, i] * s.inverse_length[i]
        s.turn_up[i - 1, 0] -= t[1, i - 1] * s.inverse_length[i - 1]
        s.turn_up[i - 1, 1] += t[0, i - 1] * s.inverse_length[i - 1]
    for e in range(n):
        x, z, inverse = t[0, e], t[1, e], s.inverse_length[e]
        across, along = z * inverse, x * inverse
        s.by_low[e, 0] += across
        s.by_low[e, 1] -= along
        s.by_up[e, 0] -= across
        s.by_up[e, 1] += along
        twice = (moment[0, e] - moment[0, e + 1]) * inverse * inverse
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


register(
    Bending,
    Called(
        "bending",
        "bending stiffness",
        (
            taken_out(
                "bending",
                "riser[*].bending",
                sets={
                    "riser[*].young_modulus": None,
                    "riser[*].bending_stiffness": None,
                    "riser[*].axial_stiffness": "=axial stiffness",
                },
            ),
        ),
        lateral=True,
    ),
    compliance=compliance,
    turn=turn,
    string=force,
    tangent=tangent,
    potential=energy,
)
