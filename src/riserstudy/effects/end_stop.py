"""End stops of tensioner cylinders: stiff springs that act beyond the ends of the stroke.

References
----------
Elementary: Hooke's law, on one side.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, put_in, register, taken_out
from riserstudy.solve.jit import inner


class EndStop(NamedTuple):
    """Two stops per cylinder."""

    shortest: np.ndarray  # (c,) reach at which the lower stop touches (m)
    longest: np.ndarray  # (c,) reach at which the upper stop touches (m)
    stiffness: np.ndarray  # (c,) (N/m)


@inner
def _beyond(stop, reach, c):
    return max(reach - stop.longest[c], 0.0) + min(reach - stop.shortest[c], 0.0)


@inner
def force(stop, s):
    """Contact force beyond the limits, zero between them."""
    for c in range(stop.stiffness.shape[0]):
        beyond = _beyond(stop, s.reach[c], c)
        if beyond != 0.0:
            s.pull[c] += stop.stiffness[c] * beyond
            s.k_pull[c] += stop.stiffness[c]
    return 0.0


@inner
def energy(stop, s):
    """Work stored in the stops (J)."""
    total = 0.0
    for c in range(stop.stiffness.shape[0]):
        total += 0.5 * stop.stiffness[c] * _beyond(stop, s.reach[c], c) ** 2
    return total


register(
    EndStop,
    Called(
        "end stops",
        "top.tensioners.stroke",
        (
            taken_out("end stops", "top.tensioners.stroke"),
            put_in(
                "end stops",
                "top.tensioners.stroke",
                {
                    "top.tensioners.stroke": {
                        "shortest": "=shortest reach",
                        "longest": "=longest reach",
                        "stop_stiffness": "100 MN/m",
                    }
                },
                "at 7.5 m, or where the table ends, 100 MN/m",
            ),
        ),
    ),
    law=force,
    potential=energy,
)
