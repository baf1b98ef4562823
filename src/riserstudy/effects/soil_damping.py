r"""Damping of soil: a dashpot parallel to each soil spring of a conductor.

.. math:: \mathbf f = -c\,\dot{\mathbf x}, \qquad c = \frac{2\xi}{\omega}\,\frac{p(Y)}{Y}

The dashpots (viscous dampers) act in the horizontal directions only. Soil dissipates energy by hysteresis. In
a cycle with the amplitude Y of the displacement, the dissipated energy is :math:`4\pi\xi` times
:math:`\tfrac12 p(Y)\,Y`, the energy of a spring with the secant stiffness. The dashpots dissipate the same
energy per cycle as the soil at the displacement Y and the period :math:`2\pi/\omega`. At other displacements
and periods, the energy that the dashpots dissipate per cycle is proportional to the square of the
displacement and to the frequency.

References
----------
Jacobsen (1930), "Steady forced vibration as influenced by damping", *Transactions of ASME* 52: equivalent
viscous damping, by the energy lost in a cycle.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register, taken_out
from riserstudy.solve.jit import inner
from riserstudy.solve.state import DISSIPATED, VELOCITY


class SoilDamping(NamedTuple):
    """Dashpots of constant damping."""

    node: np.ndarray  # (k,)
    damping: np.ndarray  # (k,) (N s/m)


@inner
def force(dashpots, s):
    """Resistance against the velocity."""
    for k in range(dashpots.node.shape[0]):
        for c in range(len(s.dim) - 1):
            s.force[c, dashpots.node[k]] -= dashpots.damping[k] * s.v[c, dashpots.node[k]]
    return 0.0


@inner
def tangent(dashpots, s):
    """Minus the derivative of the force with respect to velocity."""
    d = len(s.dim)
    for k in range(dashpots.node.shape[0]):
        for c in range(d - 1):
            s.k_node[dashpots.node[k], c * d + c] += s.rate[VELOCITY] * dashpots.damping[k]
    return 0.0


@inner
def power(dashpots, s):
    """Power dissipated (W)."""
    for k in range(dashpots.node.shape[0]):
        for c in range(len(s.dim) - 1):
            s.flow[DISSIPATED] += dashpots.damping[k] * s.v[c, dashpots.node[k]] ** 2
    return 0.0


register(
    SoilDamping,
    Called("soil damping", "soil.damping", (taken_out("soil damping", "soil.damping", "dynamics"),)),
    device=force,
    tangent=tangent,
    power=power,
)
