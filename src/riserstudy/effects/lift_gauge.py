r"""Gauge of the lower end's height above the stack and its distance from the well; exerts no force.

.. math:: \ell = z_0 - z_{stack}, \qquad a = \sqrt{x_0^2 + y_0^2}

References
----------
Elementary: a difference of elevations, and a distance from the well.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner


class LiftGauge(NamedTuple):
    """Gauge at the lower end."""

    elevation: float  # of the stack's connector (m)
    probe: int  # probe of the lift; the next ones are its rate and the distance from the well


@inner
def probe(gauge, s):
    """Report lift (m), its rate (m/s) and the horizontal distance from the well (m)."""
    up = len(s.dim) - 1
    s.probe[gauge.probe] = s.r[up, 0] - gauge.elevation
    s.probe[gauge.probe + 1] = s.v[up, 0]
    aside = 0.0
    for i in range(up):
        aside += s.r[i, 0] ** 2
    s.probe[gauge.probe + 2] = math.sqrt(aside)
    return 0.0


register(
    LiftGauge,
    Called(
        "lift gauge",
        "disconnect",
        example={"disconnect": {"at": "0.5 s", "over": "0.2 s", "stack": {"stiffness": "1 MN/m"}}},
    ),
    probe=probe,
)
