r"""Loss of a share of a constant tension during a run, because cylinders fail or a line breaks.

.. math:: F(t) = -\tfrac12 \Delta F\,\Big(1 - \cos\frac{\pi (t - t_0)}{\tau}\Big)

The magnitude of F increases from t_0 to t_0 + tau. After t_0 + tau, all of :math:`\Delta F` is lost. A force
that changes with time has no potential, so the audit counts the work of this force as supplied energy.

References
----------
Elementary: a load given over time.
"""

from __future__ import annotations

from math import cos, pi
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register, taken_out
from riserstudy.solve.jit import inner
from riserstudy.solve.state import SUPPLIED


class TensionLoss(NamedTuple):
    """Load that increases against a constant pull."""

    node: int
    load: np.ndarray  # (d,) once all is lost (N)
    start: float  # t_0 (s)
    over: float  # tau (s), above 0


@inner
def _share(loss, s):
    """Share of the loss at this time."""
    t = (s.clock[0] - loss.start) / loss.over
    if t <= 0.0:
        return 0.0
    return 1.0 if t >= 1.0 else 0.5 * (1.0 - cos(pi * t))


@inner
def force(loss, s):
    """The load."""
    share = _share(loss, s)
    for k in range(len(s.dim)):
        s.force[k, loss.node] += share * loss.load[k]
    return 0.0


@inner
def power(loss, s):
    """Power of the load (W)."""
    share = _share(loss, s)
    for k in range(len(s.dim)):
        s.flow[SUPPLIED] += share * loss.load[k] * s.v[k, loss.node]
    return 0.0


register(
    TensionLoss,
    Called("tension loss", "top.tension_loss", (taken_out("tension loss", "top.tension_loss", "dynamics"),)),
    device=force,
    power=power,
)
