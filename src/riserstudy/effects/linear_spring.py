"""A tensioner made linear: force at mid-stroke plus stiffness times extension."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import register
from riserstudy.solve.jit import inner


class LinearSpring(NamedTuple):
    """One line a cylinder."""

    tension: np.ndarray  # (c,) at mid-stroke (N)
    stiffness: np.ndarray  # (c,) (N/m)


@inner
def force(spring, s):
    """The line."""
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


register(LinearSpring, law=force, potential=energy)
