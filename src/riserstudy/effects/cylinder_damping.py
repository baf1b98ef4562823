"""Viscous damping of tensioner cylinders (Chang et al. 2020, Eq. 6).

References
----------
Chang et al. (2020), Eq. 6.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, put_in, register, taken_out
from riserstudy.solve.jit import inner
from riserstudy.solve.state import DISSIPATED, VELOCITY


class CylinderDamping(NamedTuple):
    """One damper per cylinder."""

    damping: np.ndarray  # (c,) (N s/m)


@inner
def force(damper, s):
    """Add damping times the rate of extension to the pull."""
    for c in range(damper.damping.shape[0]):
        s.pull[c] += damper.damping[c] * s.reach_rate[c]
        s.k_pull[c] += s.rate[VELOCITY] * damper.damping[c]
    return 0.0


@inner
def power(damper, s):
    """Power dissipated (W)."""
    for c in range(damper.damping.shape[0]):
        s.flow[DISSIPATED] += damper.damping[c] * s.reach_rate[c] ** 2
    return 0.0


register(
    CylinderDamping,
    Called(
        "tensioner damping",
        "top.tensioners.damping",
        (
            taken_out("tensioner damping", "top.tensioners.damping", "dynamics"),
            put_in(
                "tensioner damping",
                "top.tensioners.damping",
                {"top.tensioners.damping": "1 kN*s/m"},
                "1 kN s/m a cylinder",
                "dynamics",
            ),
        ),
    ),
    law=force,
    power=power,
)
