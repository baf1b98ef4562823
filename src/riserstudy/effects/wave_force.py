r"""Morison's inertia force: force of accelerating water across the pipe.

.. math:: f = (1 + C_a)\,\rho\,\frac{\pi D^2}{4}\,(\dot u - (\dot u \cdot t)\,t)

The force f is per unstretched length, :math:`\dot u` is the local acceleration of the water, and t is the
direction of the pipe. The part of the inertia force that depends on the acceleration of the pipe is the
effect `added_mass`. The stiffness matrix omits the change of the force with position. Over a time step, the
change of the force with position is at most a thousandth of the inertia.

References
----------
Morison, O'Brien, Johnson and Schaaf (1950), "The force exerted by surface waves on piles", *Petroleum
Transactions AIME* 189, 149-154: its inertia term.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner
from riserstudy.solve.spread import spread_and_keep, supplied
from riserstudy.solve.state import OTHER, OWN
from riserstudy.solve.vec import at, dot, mul, put, sub


class WaveForce(NamedTuple):
    """Mass of the water that the pipe displaces, with added mass."""

    mass: np.ndarray  # (n,) of the segments (kg)
    force: np.ndarray  # (d, n+1) scratch: the force on the nodes (N)


@inner
def force(wave_force, s):
    """Inertia force on the nodes."""
    for i in range(s.l0.shape[0] + 1):
        a, t = at(s.dim, s.water_rate, i), at(s.dim, s.direction, i)
        put(s.density, i, sub(a, mul(dot(a, t), t)))
    mass = wave_force.mass
    spread_and_keep(s, mass, mass, OWN, OTHER, s.density, wave_force.force, s.force)
    return 0.0


register(WaveForce, Called("wave force", "wave, and riser.added_mass"), string=force, power=supplied)
