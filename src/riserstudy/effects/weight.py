r"""Constant loads along the riser: submerged weight, and a lateral load per length.

.. math:: w = (m_{dry} + \rho_i A_i - \rho_w A_o)\,g

The submerged weight w is per unstretched length: the weight of the dry pipe and of its contents, minus the
weight of the displaced water. The submerged weight acts in the equations of the effective tension.

References
----------
Elementary: Archimedes' law; Sparks (1984), as in `axial`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register, taken_out
from riserstudy.solve.jit import inner


class Weight(NamedTuple):
    """Dead load in one direction."""

    direction: int  # 0 ... d-1, the last is up
    load: np.ndarray  # (n+1,) at the nodes (N)
    level: float = 0.0  # from which its energy counts, near what leaves where the load changes (m)


@inner
def force(weight, s):
    """The load itself."""
    for i in range(s.l0.shape[0] + 1):
        s.force[weight.direction, i] += weight.load[i]
    return 0.0


@inner
def energy(weight, s):
    """Potential energy (J)."""
    total = 0.0
    for i in range(s.l0.shape[0] + 1):
        total -= weight.load[i] * (s.r[weight.direction, i] - weight.level)
    return total


register(
    Weight,
    Called(
        "weight",
        "riser.submerged_weight",
        (taken_out("weight", "riser[*].submerged_weight", sets={"riser[*].submerged_weight": "0 N/m"}),),
    ),
    Called("line load", "riser.lateral_load"),
    string=force,
    potential=energy,
)
