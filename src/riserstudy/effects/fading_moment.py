r"""Moment at the riser's lower end that decreases to zero while the connector releases the riser.

.. math:: M_0(t) = M\,\tfrac12\bigl(1 + \cos(\pi (t - t_0)/\tau)\bigr), \qquad 0 \le t - t_0 \le \tau

Here t_0 is the time at which the release starts, and tau its duration. With the angle theta of the riser's
end, the moment has the potential energy M_0 theta. The decrease of the moment supplies the power theta
dM_0/dt.

References
----------
Elementary: the load potential of a given moment.
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.effects.rotation import by_chord, rotation, rotation_by_second
from riserstudy.solve.jit import inner
from riserstudy.solve.state import SUPPLIED
from riserstudy.solve.vec import at, plus, plus_block, upward


class FadingMoment(NamedTuple):
    """Moment of the lowest node, which the solver does not change."""

    moment: np.ndarray  # (m,) at the beginning (N m)
    start: float  # t_0 (s)
    over: float  # tau (s)


@inner
def _phase(fading, s):
    """Phase of the decrease: 0 at the beginning, pi at the end."""
    return pi * min(max((s.clock[0] - fading.start) / fading.over, 0.0), 1.0)


@inner
def place(fading, s):
    """The moment at this time."""
    left = 0.5 * (1.0 + cos(_phase(fading, s)))
    for u in range(fading.moment.shape[0]):
        s.moment[u, 0] = left * fading.moment[u]
    return 0.0


@inner
def turn(fading, s):
    """The direction of the riser's end: direction of the lowest segment minus the bending of this segment."""
    plus(s.turn, 0, rotation(upward(s.dim), at(s.dim, s.tangent, 0)))
    return 0.0


@inner
def tangent(fading, s):
    """Derivative of this direction by the end segment."""
    slope = rotation_by_second(upward(s.dim), at(s.dim, s.tangent, 0))
    plus_block(s.turn_low, 0, by_chord(s, 0, slope))
    return 0.0


@inner
def energy(fading, s):
    """Potential energy of the moment (J)."""
    total = 0.0
    for u in range(fading.moment.shape[0]):
        total += s.moment[u, 0] * s.turn[u, 0]
    return total


@inner
def power(fading, s):
    """Power that the decrease supplies (W)."""
    rate = -0.5 * sin(_phase(fading, s)) * pi / fading.over
    for u in range(fading.moment.shape[0]):
        s.flow[SUPPLIED] += rate * fading.moment[u] * s.turn[u, 0]
    return 0.0


register(
    FadingMoment,
    Called("fading moment", "disconnect.over, and a joint at the lower end"),
    place=place,
    turn=turn,
    tangent=tangent,
    potential=energy,
    power=power,
)
