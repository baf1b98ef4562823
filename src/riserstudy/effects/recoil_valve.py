r"""The recoil valve of a tensioner: it throttles the oil between cylinder and bottles.

.. math::

   \Delta F = \frac{\rho A^3}{2\,(C_d A_v)^2}\; \dot x\,|\dot x|, \qquad
   A_v(t) = A_{v0} \Big[\epsilon + (1 - \epsilon)\,\tfrac12\Big(1 + \cos\pi\,\frac{t - t_0}{\tau}\Big)\Big]

The force :math:`\Delta F` is added to the pull of a cylinder with the extension x. The opening A_v decreases
during the time t_0 < t < t_0 + tau. Before t_0 the valve is open; after t_0 + tau the valve has the residual
opening. The pull of the cylinder is never negative: if the gas cannot push the oil as fast as the piston
moves, the pull is zero. The gas is then assumed to follow the piston, and the work of the gas is dissipated
in the valve.

References
----------
Elementary: the pressure drop of an orifice, Bernoulli's law with a coefficient of discharge.
"""

from __future__ import annotations

from math import cos, pi
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner
from riserstudy.solve.state import DISSIPATED, VELOCITY


class RecoilValve(NamedTuple):
    """One valve per cylinder. It acts on the pull of the gas, so it is evaluated after the gas law."""

    resistance: np.ndarray  # (c,) of the open valve (N s2/m2)
    # (c,) share of the opening that remains, 1 for a valve that fails to close
    residual: np.ndarray
    start: float  # t_0 (s)
    over: float  # tau (s), above 0
    added: np.ndarray  # (c,) force that was last added to the pull (N)


@inner
def _resistance(valve, s, c):
    """Resistance of a valve at its present opening."""
    phase = pi * min(max((s.clock[0] - valve.start) / valve.over, 0.0), 1.0)
    opening = valve.residual[c] + (1.0 - valve.residual[c]) * 0.5 * (1.0 + cos(phase))
    return valve.resistance[c] / (opening * opening)


@inner
def force(valve, s):
    """The force of the pressure drop on the piston, at most the pull of the gas."""
    for c in range(valve.resistance.shape[0]):
        resistance, rate = _resistance(valve, s, c), s.reach_rate[c]
        added = resistance * rate * abs(rate)
        gas = max(s.pull[c], 0.0)
        if added <= -gas:
            added = -gas
            s.k_pull[c] = 0.0
        else:
            s.k_pull[c] += s.rate[VELOCITY] * 2.0 * resistance * abs(rate)
        s.pull[c] += added
        valve.added[c] = added
    return 0.0


@inner
def power(valve, s):
    """Power dissipated in the oil (W); after `force`."""
    for c in range(valve.resistance.shape[0]):
        s.flow[DISSIPATED] += valve.added[c] * s.reach_rate[c]
    return 0.0


register(RecoilValve, Called("recoil valve", "disconnect.recoil_valve"), law=force, power=power)
