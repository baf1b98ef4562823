r"""A freely floating platform: the riser's top node with the mass of the platform, and a node for its yaw.

.. math::

   \frac{d}{dt}\frac{\partial T}{\partial \dot q} - \frac{\partial T}{\partial q}
   = \sum_k \left(C_k |u|\,u_k\,e_k\right) + C_w |w|\,w + F_d,\qquad
   T = \tfrac12 \sum_k m_k (\dot r \cdot e_k)^2 + \tfrac12 I \dot\psi^2

The sums are over the axes :math:`e_k` along and across the hull, which turn with the yaw :math:`\psi` of the
hull. The velocities of the surface current and of the wind relative to the platform are u and w, and F_d is
the mean wave drift force. The time derivatives of T contain the forces and the moment that turn a moving hull
broadside if its added mass is larger sideways. The water resists the yaw with the moment :math:`C_r
|\dot\psi|\,\dot\psi`.

If the platform has first-order motion (`first_order_motion`), r excludes the first-order motion: forces and
inertia depend only on the slow motion.

The unknown for yaw is an arc, :math:`\psi` times the radius of gyration. The unknown for yaw is therefore a
length, like all other unknowns. If the scene excludes sway, the node is held across x. If the scene excludes
yaw, the hull keeps its heading.

References
----------
Elementary: Lagrange's equations of a rigid body. For loads by the square of the relative velocity and a mean
wave drift: Liu et al. (2017), in which the squares have no sign.
"""

from __future__ import annotations

from math import cos, sin, sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.effects.cylinders_in_space import shear
from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner
from riserstudy.solve.state import ACCELERATION, DISSIPATED, SUPPLIED, VELOCITY


class Vessel(NamedTuple):
    """A platform in surge, sway and yaw."""

    node: int
    yaw: int  # loose node with the arc in its last direction, 0 where there is none
    radius: float  # of the arc (m)
    heading: float  # of the hull at rest (rad)
    mass: np.ndarray  # (2,) m_k with added mass, along and across the hull (kg)
    turning: float  # I divided by the squared radius (kg)
    hull: np.ndarray  # (2,) C_k along and across the hull (kg/m)
    spin: float  # C_r divided by the cubed radius (kg/m)
    current: np.ndarray  # (2,) surface current in x and y (m/s)
    area: float  # C_w (kg/m)
    wind: np.ndarray  # (2,) wind in x and y (m/s)
    drift: np.ndarray  # (2,) F_d in x and y (N)
    cylinders: int  # number of cylinders in space with their deck ends on the vessel; 0: none
    probe: int  # first of its probes


@inner
def attitude(vessel, s):
    """Angle of the hull, and its rate."""
    if vessel.yaw == 0:
        return vessel.heading, 0.0
    up = len(s.dim) - 1
    return (vessel.heading + s.r[up, vessel.yaw] / vessel.radius, s.v[up, vessel.yaw] / vessel.radius)


@inner
def velocity(vessel, s):
    """Velocity in x and y, without first-order motion."""
    i, carried = vessel.node, s.carried[1]
    return s.v[0, i] - carried[0], (s.v[1, i] - carried[1] if len(s.dim) == 3 else 0.0)


@inner
def _pressure(along, across, u, angle):
    """Quadratic force of a flow on the hull, and the flow's velocity and speed; along and across the hull."""
    c, e = cos(angle), sin(angle)
    p, q = c * u[0] + e * u[1], c * u[1] - e * u[0]
    speed = sqrt(p * p + q * q)
    return (along * speed * p, across * speed * q), p, q, speed


@inner
def _in_plane(pair, angle):
    """Convert a vector along and across the hull to x and y."""
    c, e = cos(angle), sin(angle)
    return c * pair[0] - e * pair[1], e * pair[0] + c * pair[1]


@inner
def _flows(vessel, s):
    """Forces of current and wind in x and y, and their velocities relative to the platform."""
    angle, _ = attitude(vessel, s)
    v = velocity(vessel, s)
    water = vessel.current[0] - v[0], vessel.current[1] - v[1]
    air = vessel.wind[0] - v[0], vessel.wind[1] - v[1]
    hull, _, _, _ = _pressure(vessel.hull[0], vessel.hull[1], water, angle)
    top, _, _, _ = _pressure(vessel.area, vessel.area, air, 0.0)
    return _in_plane(hull, angle), top, water, air


@inner
def force(vessel, s):
    """Current, wind and wave drift; drag on the turning hull."""
    water, air, _, _ = _flows(vessel, s)
    for k in range(len(s.dim) - 1):
        s.force[k, vessel.node] += water[k] + air[k] + vessel.drift[k]
    if vessel.yaw > 0:
        up = len(s.dim) - 1
        arc = s.v[up, vessel.yaw]
        s.force[up, vessel.yaw] -= vessel.spin * abs(arc) * arc
    return 0.0


@inner
def _slope(along, across, u, angle):
    """Derivative of a quadratic force by the flow's velocity, in x and y, as a matrix row by row."""
    _, p, q, speed = _pressure(along, across, u, angle)
    share = 1.0 / speed if speed > 0.0 else 0.0
    pp, pq = along * (speed + share * p * p), along * share * p * q
    qp, qq = across * share * p * q, across * (speed + share * q * q)
    first = _in_plane((pp, qp), angle)  # columns in x and y, rows along and across
    second = _in_plane((pq, qq), angle)
    c, e = cos(angle), sin(angle)
    return (
        c * first[0] - e * second[0], e * first[0] + c * second[0],
        c * first[1] - e * second[1], e * first[1] + c * second[1],
    )  # fmt: skip


@inner
def tangent(vessel, s):
    """Derivative by velocity, and by yaw if the hull's drag differs along and across the hull."""
    d, up, i = len(s.dim), len(s.dim) - 1, vessel.node
    angle, _ = attitude(vessel, s)
    _, _, water, air = _flows(vessel, s)
    by_water = _slope(vessel.hull[0], vessel.hull[1], water, angle)
    by_air = _slope(vessel.area, vessel.area, air, 0.0)
    for p in range(up):
        for q in range(up):
            slope = by_water[2 * p + q] + by_air[2 * p + q]
            s.k_node[i, p * d + q] += s.rate[VELOCITY] * slope
    if vessel.yaw > 0:
        _, p, q, speed = _pressure(vessel.hull[0], vessel.hull[1], water, angle)
        twist = speed * (vessel.hull[0] - vessel.hull[1]) / vessel.radius
        turned = _in_plane((twist * q, twist * p), angle)
        for k in range(up):
            s.k_up[i, k * d + up] -= turned[k]
        arc = s.v[up, vessel.yaw]
        s.k_node[vessel.yaw, d * d - 1] += s.rate[VELOCITY] * 2.0 * vessel.spin * abs(arc)
    return 0.0


@inner
def _tensor(vessel, angle):
    """Mass tensor in x and y: xx, xy, yy."""
    mean = 0.5 * (vessel.mass[0] + vessel.mass[1])
    half = 0.5 * (vessel.mass[0] - vessel.mass[1])
    c, e = half * cos(2.0 * angle), half * sin(2.0 * angle)
    return mean + c, e, mean - c


@inner
def twisted(difference, angle, u):
    """Derivative of the mass tensor by yaw, times a vector; ``difference``: mass along minus mass across."""
    c, e = difference * cos(2.0 * angle), difference * sin(2.0 * angle)
    return c * u[1] - e * u[0], c * u[0] + e * u[1]


@inner
def inertia(vessel, s):
    """Inertial force, with the terms of a rotating hull."""
    up, i = len(s.dim) - 1, vessel.node
    angle, rate = attitude(vessel, s)
    xx, xy, yy = _tensor(vessel, angle)
    v = velocity(vessel, s)
    twist = twisted(vessel.mass[0] - vessel.mass[1], angle, v)
    carried = s.carried[2]
    a = s.a[0, i] - carried[0], (s.a[1, i] - carried[1] if up == 2 else 0.0)
    ahead = xx * a[0] + xy * a[1] + rate * twist[0], xy * a[0] + yy * a[1] + rate * twist[1]
    for k in range(up):
        s.force[k, i] -= ahead[k]
        s.carried[3, k] = -ahead[k]
    if vessel.yaw > 0:
        s.force[up, vessel.yaw] -= vessel.turning * s.a[up, vessel.yaw]
        s.force[up, vessel.yaw] += 0.5 * (v[0] * twist[0] + v[1] * twist[1]) / vessel.radius
    return 0.0


@inner
def mass(vessel, s):
    """Mass times d a / d r; the rotation of the hull changes little over a time step and is omitted."""
    d, up, i = len(s.dim), len(s.dim) - 1, vessel.node
    angle, _ = attitude(vessel, s)
    xx, xy, yy = _tensor(vessel, angle)
    s.k_node[i, 0] += s.rate[ACCELERATION] * xx
    if up == 2:
        s.k_node[i, 1] += s.rate[ACCELERATION] * xy
        s.k_node[i, d] += s.rate[ACCELERATION] * xy
        s.k_node[i, d + 1] += s.rate[ACCELERATION] * yy
    if vessel.yaw > 0:
        s.k_node[vessel.yaw, d * d - 1] += s.rate[ACCELERATION] * vessel.turning
    return 0.0


@inner
def lump(vessel, s):
    """Mass of its nodes."""
    d, up, i = len(s.dim), len(s.dim) - 1, vessel.node
    angle, _ = attitude(vessel, s)
    xx, xy, yy = _tensor(vessel, angle)
    s.lump[0, i] += xx
    if up == 2:
        s.lump[1, i] += xy
        s.lump[d + 1, i] += yy
    if vessel.yaw > 0:
        s.lump[d * d - 1, vessel.yaw] += vessel.turning
    return 0.0


@inner
def kinetic(vessel, s):
    """Kinetic energy (J)."""
    angle, _ = attitude(vessel, s)
    xx, xy, yy = _tensor(vessel, angle)
    v = velocity(vessel, s)
    total = 0.5 * (xx * v[0] * v[0] + yy * v[1] * v[1]) + xy * v[0] * v[1]
    if vessel.yaw > 0:
        total += 0.5 * vessel.turning * s.v[len(s.dim) - 1, vessel.yaw] ** 2
    return total


@inner
def power(vessel, s):
    """Power dissipated into water and air; supplied by their motion and by wave drift (W).

    The forces that the vessel transmits to the riser's top also do work on the first-order motion. The cause
    of this prescribed motion supplies their power.
    """
    water, air, past, blown = _flows(vessel, s)
    v = velocity(vessel, s)
    for k in range(len(s.dim) - 1):
        s.flow[DISSIPATED] += water[k] * past[k] + air[k] * blown[k]
        s.flow[SUPPLIED] += water[k] * (past[k] + v[k]) + air[k] * (blown[k] + v[k])
        s.flow[SUPPLIED] += vessel.drift[k] * v[k]
        passed_on = water[k] + air[k] + vessel.drift[k] + s.carried[3, k]
        s.flow[SUPPLIED] += passed_on * s.carried[1, k]
    if vessel.yaw > 0:
        arc = s.v[len(s.dim) - 1, vessel.yaw]
        s.flow[DISSIPATED] += vessel.spin * abs(arc) * arc * arc
    return 0.0


@inner
def probe(vessel, s):
    """Report speed, riser's force and environment's force on the platform, by direction; then yaw."""
    water, air, _, _ = _flows(vessel, s)
    k = vessel.probe
    by_ring = shear(s, s.length.shape[0] - 1)  # zero without cylinders in space
    for c in range(len(s.dim) - 1):
        s.probe[k] = s.v[c, vessel.node] - s.carried[1, c] + s.platform[1, c]
        s.probe[k + 1] = s.ends[0, 1, c] + s.ends[1, 1, c] + by_ring[c]
        for j in range(vessel.cylinders):
            s.probe[k + 1] -= s.pull[j] * s.line[c, j]
        s.probe[k + 2] = water[c] + air[c] + vessel.drift[c]
        k += 3
    if vessel.yaw > 0:
        angle, _ = attitude(vessel, s)
        s.probe[k] = angle - vessel.heading
    return 0.0


register(
    Vessel,
    Called("vessel", "vessel"),
    device=force,
    tangent=tangent,
    device_inertia=inertia,
    mass=mass,
    lump=lump,
    kinetic=kinetic,
    power=power,
    probe=probe,
)
