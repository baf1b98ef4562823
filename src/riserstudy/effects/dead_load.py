"""A force of constant magnitude and direction on one node (a dead load), such as a constant tension.

References
----------
Elementary: a dead load.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner


class DeadLoad(NamedTuple):
    """Dead load on a node."""

    node: int
    load: np.ndarray  # (d,) (N)


@inner
def force(dead, s):
    """The load itself."""
    for k in range(len(s.dim)):
        s.force[k, dead.node] += dead.load[k]
    return 0.0


@inner
def energy(dead, s):
    """Potential of the load (J)."""
    total = 0.0
    for k in range(len(s.dim)):
        total -= dead.load[k] * s.r[k, dead.node]
    return total


register(
    DeadLoad,
    Called("constant tension", "top.tension"),
    Called("lateral force", "top.lateral_force"),
    device=force,
    potential=energy,
)
