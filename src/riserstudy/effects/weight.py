r"""Weight in water (or air) per unstretched length, as the effective tension sees it.

.. math:: w = (m_{dry} + \rho_i A_i - \rho_w A_o)\,g
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.roles import register
from riserstudy.jit import inner


class Weight(NamedTuple):
    """Weight of the string, lumped halves."""

    weight: np.ndarray  # (n+1,) weight at the nodes, positive down (N)


@inner
def force(weight, s):
    """Weight pulls down; the last direction is up."""
    up = len(s.dim) - 1
    for i in range(s.l0.shape[0] + 1):
        s.force[up, i] -= weight.weight[i]
    return 0.0


@inner
def energy(weight, s):
    """Potential energy (J)."""
    up = len(s.dim) - 1
    total = 0.0
    for i in range(s.l0.shape[0] + 1):
        total += weight.weight[i] * s.r[up, i]
    return total


register(Weight, string=force, potential=energy)
