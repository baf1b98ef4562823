r"""Axial elasticity of the pipe.

.. math:: T_e = EA\,(\ell / \ell_0 - 1)

Here EA is the axial stiffness, and the tension T_e is the effective tension. The stretched length of a
segment is divided by its unstretched length. Because all weights are submerged weights, the model needs no
separate forces for the pressures of contents and sea. Weights and fluid loads are given per unstretched
length.

References
----------
Elementary: Hooke's law. For the absence of pressures: Sparks (1984), "The influence of tension, pressure and
weight on pipe and riser deformations and stresses", *Journal of Energy Resources Technology* 106, 46-54.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner
from riserstudy.solve.vec import add, at, mul, outer, plus, plus_block, sub, unity


class Axial(NamedTuple):
    """Axial stiffness of the segments."""

    stiffness: np.ndarray  # (n,) EA divided by the unstretched length (N/m)


@inner
def force(axial, s):
    """Tension along each segment."""
    for e in range(s.l0.shape[0]):
        tension = axial.stiffness[e] * (s.length[e] - s.l0[e])
        plus(s.segment, e, mul(tension, at(s.dim, s.tangent, e)))
    return 0.0


@inner
def tangent(axial, s):
    """Elastic stiffness along the segment, and T / length across it."""
    unit = unity(s.dim)
    for e in range(s.l0.shape[0]):
        t = at(s.dim, s.tangent, e)
        along = outer(t, t)
        tension = axial.stiffness[e] * (s.length[e] - s.l0[e])
        elastic = mul(axial.stiffness[e], along)
        string = mul(tension * s.inverse_length[e], sub(unit, along))
        plus_block(s.k_segment, e, add(elastic, string))
    return 0.0


@inner
def energy(axial, s):
    """Strain energy (J)."""
    total = 0.0
    for e in range(s.l0.shape[0]):
        total += 0.5 * axial.stiffness[e] * (s.length[e] - s.l0[e]) ** 2
    return total


register(Axial, Called("axial elasticity", "riser"), string=force, tangent=tangent, potential=energy)
