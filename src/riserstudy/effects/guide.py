r"""Guide, such as a frame or a centraliser: a spring between a point of the riser and the axis of the well.

.. math:: \mathbf f = -k\,\mathbf x, \qquad V = \tfrac12 k\,|\mathbf x|^2

The spring, with the stiffness k and the displacement x, acts in the horizontal directions only. At the guide,
the shear force has a jump equal to the force of the guide, so the curve of the bending moment has a corner.

References
----------
Hooke's law, at a point.
"""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.effects.registry import Called, register, taken_out
from riserstudy.solve.jit import inner


class Guide(NamedTuple):
    """Lateral spring at a node, without force on the vertical through the well."""

    node: int
    stiffness: float  # (N/m)


@inner
def force(guide, s):
    """Pull towards the vertical through the well."""
    for c in range(len(s.dim) - 1):
        s.force[c, guide.node] -= guide.stiffness * s.r[c, guide.node]
    return 0.0


@inner
def tangent(guide, s):
    """Minus the derivative of the force by the node's position."""
    d = len(s.dim)
    for c in range(d - 1):
        s.k_node[guide.node, c * d + c] += guide.stiffness
    return 0.0


@inner
def energy(guide, s):
    """Energy of the spring (J)."""
    square = 0.0
    for c in range(len(s.dim) - 1):
        square += s.r[c, guide.node] ** 2
    return 0.5 * guide.stiffness * square


register(
    Guide,
    Called(
        "guide",
        "riser.guide_below",
        (taken_out("guide", "riser[*].guide_below", "lateral"),),
        example={"riser[1].guide_below": {"stiffness": "10 kN/m"}},
        lateral=True,
    ),
    device=force,
    tangent=tangent,
    potential=energy,
)
