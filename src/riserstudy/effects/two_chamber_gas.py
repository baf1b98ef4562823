r"""Tensioner gas on both sides of a piston: high pressure pulls the ring up, low pressure pushes back.

.. math:: F = A_h P_{h0} \left(\frac{V_{h0}}{V_{h0} - A_h\,x}\right)^k
              - A_l P_{l0} \left(\frac{V_{l0}}{V_{l0} + A_l\,x}\right)^k - W

Here x is the extension of the cylinder, and W is the weight of piston and rod (Liu et al. 2020, Eq. 11). The
piston stroke in the paper is -x. The high pressure acts on the annulus around the rod, and the low pressure
acts on the bore.

References
----------
Liu et al. (2020), Eq. 11. Elementary: Poisson's law of a polytropic gas.
"""

from __future__ import annotations

from math import inf
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register, taken_out
from riserstudy.solve.jit import inner


class TwoChamberGas(NamedTuple):
    """Two chambers per cylinder, one on each side of the piston."""

    high_area: np.ndarray  # (c,) under high pressure (m2)
    high_pressure: np.ndarray  # (c,) at mid-stroke, absolute (Pa)
    high_volume: np.ndarray  # (c,) at mid-stroke (m3)
    low_area: np.ndarray  # (c,) under low pressure (m2)
    low_pressure: np.ndarray  # (c,) at mid-stroke, absolute (Pa)
    low_volume: np.ndarray  # (c,) at mid-stroke (m3)
    exponent: np.ndarray  # (c,) polytropic exponent of both
    weight: np.ndarray  # (c,) of piston and rod (N)


@inner
def force(gas, s):
    """Pressures times areas; infinite once a gas volume is zero or less."""
    for c in range(gas.exponent.shape[0]):
        high = gas.high_volume[c] - gas.high_area[c] * s.reach[c]
        low = gas.low_volume[c] + gas.low_area[c] * s.reach[c]
        if high <= 0.0 or low <= 0.0:
            s.pull[c] += inf if high <= 0.0 else -inf
            continue
        k = gas.exponent[c]
        up = gas.high_area[c] * gas.high_pressure[c] * (gas.high_volume[c] / high) ** k
        down = gas.low_area[c] * gas.low_pressure[c] * (gas.low_volume[c] / low) ** k
        s.pull[c] += up - down - gas.weight[c]
        s.k_pull[c] += k * (up * gas.high_area[c] / high + down * gas.low_area[c] / low)
    return 0.0


@inner
def energy(gas, s):
    """Work stored in both gases since mid-stroke, and potential energy of the piston (J)."""
    total = 0.0
    for c in range(gas.exponent.shape[0]):
        k = gas.exponent[c]
        high = gas.high_volume[c] - gas.high_area[c] * s.reach[c]
        low = gas.low_volume[c] + gas.low_area[c] * s.reach[c]
        full = gas.high_pressure[c] * gas.high_volume[c]
        total += full * ((gas.high_volume[c] / high) ** (k - 1.0) - 1.0) / (k - 1.0)
        full = gas.low_pressure[c] * gas.low_volume[c]
        total += full * ((gas.low_volume[c] / low) ** (k - 1.0) - 1.0) / (k - 1.0)
        total -= gas.weight[c] * s.reach[c]
    return total


register(
    TwoChamberGas,
    Called(
        "two-chamber gas tensioner",
        "top.tensioners.two_chamber_gas",
        (
            taken_out(
                "nonlinear two-chamber law",
                "top.tensioners.two_chamber_gas",
                sets={"top.tensioners.linearised": {"by": "tangent"}},
            ),
        ),
    ),
    law=force,
    potential=energy,
)
