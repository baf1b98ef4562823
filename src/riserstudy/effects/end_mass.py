r"""A concentrated mass at a node: LMRP, tension ring, telescopic joint.

The concentrated mass has a submerged weight and inertia. Added mass :math:`m_a` and quadratic drag can differ
between horizontal and vertical motion. With the velocity u of the water relative to the mass, the
acceleration :math:`\dot w` of the water, the acceleration a of the mass and the displaced volume V, the force
of the water is

.. math:: f = \tfrac12 \rho\,C_D A\,|u|\,u + (\rho V + m_a)\,\dot w - m_a\,a

Horizontal drag acts in the direction of the horizontal relative velocity. Vertical drag is computed
separately.

References
----------
Elementary: Newton's second law. Drag as in `drag`, force of accelerating water as in `wave_force`.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, put_in, register, taken_out
from riserstudy.solve.jit import inner
from riserstudy.solve.state import ACCELERATION, DISSIPATED, SUPPLIED, VELOCITY


class EndMass(NamedTuple):
    """One concentrated mass."""

    node: int
    weight: float  # submerged weight, positive down (N)
    mass: np.ndarray  # (d,) mass with added mass, by direction (kg)
    drag: np.ndarray  # (2,) rho C_D A / 2 horizontally and vertically (kg/m)
    displaced: np.ndarray  # (d,) mass of displaced water with added mass, by direction (kg)


@inner
def force(body, s):
    """Weight, drag, and force of accelerating water."""
    up, i = len(s.dim) - 1, body.node
    sideways = 0.0
    for k in range(up):
        sideways += (s.water[k, i] - s.v[k, i]) ** 2
    for k in range(up):
        s.force[k, i] += body.drag[0] * sqrt(sideways) * (s.water[k, i] - s.v[k, i])
    rise = s.water[up, i] - s.v[up, i]
    s.force[up, i] += body.drag[1] * abs(rise) * rise - body.weight
    for k in range(up + 1):
        s.force[k, i] += body.displaced[k] * s.water_rate[k, i]
    return 0.0


@inner
def tangent(body, s):
    """Derivative of the drag with respect to velocity."""
    d, up, i = len(s.dim), len(s.dim) - 1, body.node
    sideways = 0.0
    for k in range(up):
        sideways += (s.water[k, i] - s.v[k, i]) ** 2
    speed = sqrt(sideways)
    if speed > 0.0:
        for p in range(up):
            u = s.water[p, i] - s.v[p, i]
            for q in range(up):
                slope = u * (s.water[q, i] - s.v[q, i]) / speed
                if p == q:
                    slope += speed
                s.k_node[i, p * d + q] += s.rate[VELOCITY] * body.drag[0] * slope
    rise = s.water[up, i] - s.v[up, i]
    s.k_node[i, d * d - 1] += s.rate[VELOCITY] * 2.0 * body.drag[1] * abs(rise)
    return 0.0


@inner
def inertia(body, s):
    """Inertial force."""
    for k in range(len(s.dim)):
        s.force[k, body.node] -= body.mass[k] * s.a[k, body.node]
    return 0.0


@inner
def mass(body, s):
    """Mass times d a / d r."""
    d = len(s.dim)
    for k in range(d):
        s.k_node[body.node, k * d + k] += s.rate[ACCELERATION] * body.mass[k]
    return 0.0


@inner
def lump(body, s):
    """Mass of its node."""
    d = len(s.dim)
    for k in range(d):
        s.lump[k * d + k, body.node] += body.mass[k]
    return 0.0


@inner
def kinetic(body, s):
    """Kinetic energy (J)."""
    total = 0.0
    for k in range(len(s.dim)):
        total += 0.5 * body.mass[k] * s.v[k, body.node] ** 2
    return total


@inner
def energy(body, s):
    """Potential energy of the weight (J)."""
    return body.weight * s.r[len(s.dim) - 1, body.node]


@inner
def power(body, s):
    """Power dissipated into the water and supplied by its motion (W)."""
    up, i = len(s.dim) - 1, body.node
    sideways = 0.0
    for k in range(up):
        sideways += (s.water[k, i] - s.v[k, i]) ** 2
    speed = sqrt(sideways)
    rise = s.water[up, i] - s.v[up, i]
    s.flow[DISSIPATED] += body.drag[0] * speed**3 + body.drag[1] * abs(rise) ** 3
    s.flow[SUPPLIED] += body.drag[1] * abs(rise) * rise * s.water[up, i]
    for k in range(up):
        s.flow[SUPPLIED] += body.drag[0] * speed * (s.water[k, i] - s.v[k, i]) * s.water[k, i]
    for k in range(up + 1):
        s.flow[SUPPLIED] += body.displaced[k] * s.water_rate[k, i] * s.v[k, i]
    return 0.0


register(
    EndMass,
    Called(
        "end mass",
        "bottom.body, top.body",
        (
            taken_out("body's drag", "bottom.body.drag_area"),
            taken_out("body's added mass", "bottom.body.added_mass", "dynamics"),
            put_in(
                "body's drag",
                "bottom.body.drag_area",
                {"bottom.body.drag_area": {"horizontal": "15 m^2", "vertical": "14 m^2"}},
                "15 m2 across and 14 m2 along",
                "dynamics",
            ),
            put_in(
                "body's added mass",
                "bottom.body.added_mass",
                {"bottom.body.added_mass": {"horizontal": "=half the body"}},
                "half of the body's mass across",
                "dynamics",
                "lateral",
            ),
        ),
    ),
    Called("piston mass", "top.tensioners.two_chamber_gas.pistons"),
    device=force,
    tangent=tangent,
    device_inertia=inertia,
    mass=mass,
    lump=lump,
    potential=energy,
    kinetic=kinetic,
    power=power,
)
