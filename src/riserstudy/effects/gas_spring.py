r"""Gas of a tensioner cylinder, whose pressure follows from its volume by a polytropic law.

.. math:: F = A\,P_0 \left(\frac{V_0}{V_0 - A\,x}\right)^k

Here x is the extension of the cylinder from mid-stroke, and A is the area of the piston (Chang et al. 2020,
Eqs. 1-3). The gas has the pressure P_0 and the volume V_0 at mid-stroke, and the polytropic exponent k. The
symbol X in the paper is -x, the rise of the ring relative to the platform.

References
----------
Elementary: Poisson's law of a polytropic gas. Chang et al. (2020), Eqs. 1-3.
"""

from __future__ import annotations

from math import inf
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register, taken_out
from riserstudy.solve.jit import inner


class GasSpring(NamedTuple):
    """One chamber per cylinder."""

    area: np.ndarray  # (c,) piston area under gas (m2)
    pressure: np.ndarray  # (c,) at mid-stroke, absolute (Pa)
    volume: np.ndarray  # (c,) at mid-stroke (m3)
    exponent: np.ndarray  # (c,) polytropic exponent


@inner
def force(gas, s):
    """Gas pressure times area; infinite once the gas volume is zero or less."""
    for c in range(gas.area.shape[0]):
        left = gas.volume[c] - gas.area[c] * s.reach[c]
        if left <= 0.0:
            s.pull[c] += inf
            continue
        pull = gas.area[c] * gas.pressure[c] * (gas.volume[c] / left) ** gas.exponent[c]
        s.pull[c] += pull
        s.k_pull[c] += gas.exponent[c] * pull * gas.area[c] / left
    return 0.0


@inner
def energy(gas, s):
    """Work stored in the gas since mid-stroke (J)."""
    total = 0.0
    for c in range(gas.area.shape[0]):
        left = gas.volume[c] - gas.area[c] * s.reach[c]
        k = gas.exponent[c]
        full = gas.pressure[c] * gas.volume[c]
        total += full * ((gas.volume[c] / left) ** (k - 1.0) - 1.0) / (k - 1.0)
    return total


register(
    GasSpring,
    Called(
        "gas tensioner",
        "top.tensioners.gas",
        (
            taken_out(
                "nonlinear gas law",
                "top.tensioners.gas",
                sets={"top.tensioners.linearised": {"by": "tangent"}},
            ),
        ),
    ),
    law=force,
    potential=energy,
)
