"""A linearised tensioner: force at mid-stroke plus stiffness times extension.

References
----------
Elementary: Hooke's law.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner


class LinearSpring(NamedTuple):
    """One linear law per cylinder."""

    tension: np.ndarray  # (c,) at mid-stroke (N)
    stiffness: np.ndarray  # (c,) (N/m)


@inner
def force(spring, s):
    """Tension at mid-stroke plus stiffness times reach."""
    for c in range(spring.tension.shape[0]):
        s.pull[c] += spring.tension[c] + spring.stiffness[c] * s.reach[c]
        s.k_pull[c] += spring.stiffness[c]
    return 0.0


@inner
def energy(spring, s):
    """Work stored since mid-stroke (J)."""
    total = 0.0
    for c in range(spring.tension.shape[0]):
        total += (spring.tension[c] + 0.5 * spring.stiffness[c] * s.reach[c]) * s.reach[c]
    return total


register(
    LinearSpring,
    Called("linear tensioner", "top.tensioners.linear or linearised"),
    "gas tensioner",
    "two-chamber gas tensioner",
    law=force,
    potential=energy,
)
