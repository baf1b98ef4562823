r"""Foreshortening: a bent segment is longer than its chord, which adds to its tension.

.. math:: T_e = EA\,\tfrac{\ell_0^2}{24}\,\kappa^2,\qquad
          \kappa^2 = \frac{M_e^2 + M_e M_{e+1} + M_{e+1}^2}{3\,EI^2}

Here :math:`M_e` and :math:`M_{e+1}` are the bending moments at the ends of segment e. Without foreshortening,
the tension due to lateral motion of a riser that is held at both ends would have an error of second order in
the segment length.

References
----------
Elementary: the chord of an arc is shorter than the arc by its squared curvature times its cubed length,
divided by 24. Theory, (1).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner
from riserstudy.solve.vec import at, mul, outer, plus, plus_block, sub, unity


class Foreshortening(NamedTuple):
    """Tension of a segment due to its squared moments."""

    slope: np.ndarray  # (n,) EA l0^2 / (72 EI^2) (1/(N m2))


@inner
def _tension(bent, s, e):
    total = 0.0
    for u in range(len(s.dof) - len(s.dim)):
        low, up = s.moment[u, e], s.moment[u, e + 1]
        total += low * low + low * up + up * up
    return bent.slope[e] * total


@inner
def force(bent, s):
    """Tension along each segment."""
    for e in range(s.l0.shape[0]):
        plus(s.segment, e, mul(_tension(bent, s, e), at(s.dim, s.tangent, e)))
    return 0.0


@inner
def tangent(bent, s):
    """Derivative with respect to the moments and the direction of the segment."""
    unit = unity(s.dim)
    d, m = len(s.dim), len(s.dof) - len(s.dim)
    for e in range(s.l0.shape[0]):
        t = at(s.dim, s.tangent, e)
        across = sub(unit, outer(t, t))
        plus_block(s.k_segment, e, mul(_tension(bent, s, e) * s.inverse_length[e], across))
        for u in range(m):
            low, up = s.moment[u, e], s.moment[u, e + 1]
            for k in range(d):
                s.by_low[e, k * m + u] += bent.slope[e] * (2.0 * low + up) * s.tangent[k, e]
                s.by_up[e, k * m + u] += bent.slope[e] * (2.0 * up + low) * s.tangent[k, e]
    return 0.0


register(
    Foreshortening, Called("foreshortening", "bending stiffness", lateral=True), string=force, tangent=tangent
)
