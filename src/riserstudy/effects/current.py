"""Steady current: horizontal water velocity from a table over elevation, with linear interpolation.

Below and above the elevations of the table, the end values of the table apply. The current is evaluated at
the position of a node in the deformed riser.

References
----------
Elementary: linear interpolation; profiles come from the scene.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, put_in, register, taken_out
from riserstudy.solve.jit import inner
from riserstudy.solve.state import ENDED


class Current(NamedTuple):
    """Profile of the current."""

    elevation: np.ndarray  # (k,) rising (m)
    speed: np.ndarray  # (k,) (m/s)
    heading: np.ndarray  # (d-1,) unit vector of the flow in the horizontal directions
    near: np.ndarray  # (n+1,) scratch: the interval of the table in which a node was last
    ramp: float  # time over which the current increases linearly from zero (s), 0 for a step


@inner
def drive(current, s):
    """Water velocity at the nodes, and its change with elevation."""
    up = len(s.dim) - 1
    z, speed = current.elevation, current.speed
    share = s.clock[1]
    if s.clock[0] < ENDED * current.ramp:
        share *= s.clock[0] / current.ramp
    last = z.shape[0] - 1
    for i in range(s.l0.shape[0] + 1):
        here = s.r[up, i]
        value, slope = speed[0], 0.0
        if here >= z[last]:
            value = speed[last]
        elif here > z[0]:
            k = current.near[i]  # start from the previous interval: the node has hardly moved
            while z[k + 1] <= here:
                k += 1
            while z[k] > here:
                k -= 1
            current.near[i] = k
            slope = (speed[k + 1] - speed[k]) / (z[k + 1] - z[k])
            value = speed[k] + slope * (here - z[k])
        for c in range(up):
            s.water[c, i] += share * value * current.heading[c]
            s.shear[c, i] += share * slope * current.heading[c]
    return 0.0


register(
    Current,
    Called(
        "current",
        "current",
        (
            taken_out("current", "current"),
            put_in(
                "current",
                "current",
                {
                    "current": {
                        "profile": {
                            "shape": "uniform",
                            "surface_speed": "0.25 m/s",
                            "seabed": "=lowest",
                            "surface": "=highest",
                        }
                    }
                },
                "0.25 m/s from bottom to top",
                "drag",
                "lateral",
            ),
        ),
    ),
    drive=drive,
)
