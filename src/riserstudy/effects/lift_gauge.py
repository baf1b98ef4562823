r"""A gauge of the lift and lift rate of the riser's lower end above the stack; it exerts no force.

.. math:: \ell = z_0 - z_{stack}

References
----------
Elementary: a difference of elevations.
"""

from __future__ import annotations

from typing import NamedTuple

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner


class LiftGauge(NamedTuple):
    """Gauge at the lower end."""

    elevation: float  # of the stack's connector (m)
    probe: int  # of the lift; the next one is of its rate


@inner
def probe(gauge, s):
    """Report lift (m) and its rate (m/s)."""
    up = len(s.dim) - 1
    s.probe[gauge.probe] = s.r[up, 0] - gauge.elevation
    s.probe[gauge.probe + 1] = s.v[up, 0]
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
