"""A node held in some directions, at rest or moving with the platform."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.roles import register
from riserstudy.jit import inner


class Support(NamedTuple):
    """Held directions of one node."""

    node: int
    place: np.ndarray  # (d,) position with the platform at rest (m)
    held: np.ndarray  # (d,) 1 where held, else 0
    motion: np.ndarray  # (d,) platform motion that a direction follows (0 ... 5), -1 for none


@inner
def place(support, s):
    """Put the node where it is held, with the velocity and acceleration it has there."""
    i = support.node
    for k in range(len(s.dim)):
        if support.held[k] > 0:
            m = support.motion[k]
            s.r[k, i] = support.place[k] + (s.platform[0, m] if m >= 0 else 0.0)
            s.v[k, i] = s.platform[1, m] if m >= 0 else 0.0
            s.a[k, i] = s.platform[2, m] if m >= 0 else 0.0
    return 0.0


register(Support, place=place)
