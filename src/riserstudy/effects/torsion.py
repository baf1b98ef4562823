r"""Torsion of the riser: a spring that resists the yaw of the platform.

.. math:: N = -\psi \Big/ \sum_k \frac{L_k}{G I_{p,k}}

Here :math:`\psi` is the yaw, and section k has the length :math:`L_k` and the torsional stiffness :math:`G
I_{p,k}`. The rotary inertia of the riser in torsion is neglected: the lowest torsional frequency is hundreds
of times the yaw frequency.

References
----------
Elementary: Coulomb's and Saint-Venant's torsion of a tube, in series.
"""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner


class Torsion(NamedTuple):
    """Spring on the yaw of a platform."""

    yaw: int  # loose node with the arc of the yaw in its last direction
    stiffness: float  # force per displacement of the arc (N/m)


@inner
def force(torsion, s):
    """Restoring force on the arc."""
    up = len(s.dim) - 1
    s.force[up, torsion.yaw] -= torsion.stiffness * s.r[up, torsion.yaw]
    return 0.0


@inner
def tangent(torsion, s):
    """Minus the derivative of the force with respect to the arc."""
    s.k_node[torsion.yaw, len(s.dim) ** 2 - 1] += torsion.stiffness
    return 0.0


@inner
def energy(torsion, s):
    """Potential energy (J)."""
    return 0.5 * torsion.stiffness * s.r[len(s.dim) - 1, torsion.yaw] ** 2


register(
    Torsion,
    Called("torsion", "vessel.yaw, and riser.shear_modulus"),
    device=force,
    tangent=tangent,
    potential=energy,
)
