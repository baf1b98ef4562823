r"""Axial structural damping, proportional to the rate of stretching (Kelvin-Voigt).

.. math:: T_e = c_e\,\dot\ell_e

Here c_e is the damping coefficient of segment e. Liu et al. (2020), Eq. 2, use :math:`c_e = 2 \zeta \sqrt{m_e
k_e}` for each body of their model, with its mass, its stiffness and the damping ratio :math:`\zeta`.

References
----------
Elementary: Kelvin and Voigt's solid. Liu et al. (2020), Eq. 2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, put_in, register, taken_out
from riserstudy.solve.jit import inner
from riserstudy.solve.state import DISSIPATED, VELOCITY
from riserstudy.solve.vec import add, at, dot, mul, outer, plus, plus_block, sub, unity


class AxialDamping(NamedTuple):
    """Dampers along the segments."""

    damping: np.ndarray  # (n,) force per rate of lengthening (N s/m)


@inner
def force(damper, s):
    """Tension that opposes the rate of lengthening."""
    for e in range(s.l0.shape[0]):
        t = at(s.dim, s.tangent, e)
        rate = dot(t, sub(at(s.dim, s.v, e + 1), at(s.dim, s.v, e)))
        plus(s.segment, e, mul(damper.damping[e] * rate, t))
    return 0.0


@inner
def tangent(damper, s):
    """Derivative with respect to the velocity and the direction of the segment."""
    unit = unity(s.dim)
    for e in range(s.l0.shape[0]):
        t = at(s.dim, s.tangent, e)
        relative = sub(at(s.dim, s.v, e + 1), at(s.dim, s.v, e))
        rate = dot(t, relative)
        along = outer(t, t)
        turning = sub(relative, mul(rate, t))  # part that changes the direction of the segment
        c = damper.damping[e]
        slope = add(
            mul(s.rate[VELOCITY], along),
            mul(s.inverse_length[e], add(outer(t, turning), mul(rate, sub(unit, along)))),
        )
        plus_block(s.k_segment, e, mul(c, slope))
    return 0.0


@inner
def power(damper, s):
    """Power dissipated (W)."""
    for e in range(s.l0.shape[0]):
        t = at(s.dim, s.tangent, e)
        rate = dot(t, sub(at(s.dim, s.v, e + 1), at(s.dim, s.v, e)))
        s.flow[DISSIPATED] += damper.damping[e] * rate * rate
    return 0.0


register(
    AxialDamping,
    Called(
        "axial damping",
        "riser.structural_damping",
        (
            taken_out("structural damping", "riser[*].structural_damping", "dynamics"),
            put_in(
                "structural damping",
                "riser[*].structural_damping",
                {"riser[*].structural_damping": {"ratio": 0.005, "at_period": "10 s"}},
                "0.5 % of critical at 10 s",
                "dynamics",
            ),
        ),
    ),
    string=force,
    tangent=tangent,
    power=power,
)
