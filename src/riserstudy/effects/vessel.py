r"""A platform that is free to surge: the riser's top node with the mass of a ship.

.. math::

   (m + m_a)\,\ddot x = C_h |u|\,u_x + C_w |w|\,w_x + F_d + F_t + F_{riser},\qquad
   F_t = \mathrm{sat}\big(G\,(x_c(t) - x) - D\,\dot x\big)

with u and w the velocities of the surface current and of the wind relative to the platform, F_d the mean
wave drift and x_c the position that the thrusters are told to go to, which comes up as
:math:`x_c (1 - e^{-t/\tau})`. Sway is held. A lag of the thrusters would be one more unknown; it is left out.
"""

from __future__ import annotations

from math import exp, sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.effects.roles import register
from riserstudy.jit import inner


class Vessel(NamedTuple):
    """A platform in surge."""

    node: int
    mass: float  # with added mass (kg)
    hull: float  # C_h (kg/m)
    current: np.ndarray  # (2,) surface current along and across the motion (m/s)
    area: float  # C_w (kg/m)
    wind: np.ndarray  # (2,) wind along and across the motion (m/s)
    drift: float  # F_d (N)
    gain: float  # G (N/m)
    damping: float  # D (N s/m)
    command: float  # x_c (m)
    rise: float  # tau (s), 0 for at once
    saturation: float  # largest thrust (N), infinite for none
    probe: int  # first of its four probes


@inner
def _pressure(coefficient, flow, v):
    """Quadratic force of a flow on the platform, its relative velocity, and minus its slope by v."""
    along = flow[0] - v
    speed = sqrt(along * along + flow[1] * flow[1])
    slope = speed
    if speed > 0.0:
        slope += along * along / speed
    return coefficient * speed * along, along, coefficient * slope


@inner
def _thrust(vessel, s):
    """Thrust, and whether it is below saturation."""
    told = vessel.command
    if vessel.rise > 0.0:
        told *= 1.0 - exp(-max(s.clock[0], 0.0) / vessel.rise)
    i = vessel.node
    wanted = vessel.gain * (told - s.r[0, i]) - vessel.damping * s.v[0, i]
    if abs(wanted) < vessel.saturation:
        return wanted, True
    return (vessel.saturation if wanted > 0.0 else -vessel.saturation), False


@inner
def _environment(vessel, s):
    """Force of current, wind and wave drift."""
    v = s.v[0, vessel.node]
    water, _, _ = _pressure(vessel.hull, vessel.current, v)
    air, _, _ = _pressure(vessel.area, vessel.wind, v)
    return water + air + vessel.drift


@inner
def force(vessel, s):
    """Current, wind, wave drift and thrusters."""
    thrust, _ = _thrust(vessel, s)
    s.force[0, vessel.node] += _environment(vessel, s) + thrust
    return 0.0


@inner
def tangent(vessel, s):
    """Derivative by position and velocity."""
    i = vessel.node
    _, _, water = _pressure(vessel.hull, vessel.current, s.v[0, i])
    _, _, air = _pressure(vessel.area, vessel.wind, s.v[0, i])
    s.k_node[i, 0] += s.rate[0] * (water + air)
    _, follows = _thrust(vessel, s)
    if follows:
        s.k_node[i, 0] += vessel.gain + s.rate[0] * vessel.damping
    return 0.0


@inner
def inertia(vessel, s):
    """Inertial force."""
    s.force[0, vessel.node] -= vessel.mass * s.a[0, vessel.node]
    return 0.0


@inner
def mass(vessel, s):
    """Mass times d a / d r."""
    s.k_node[vessel.node, 0] += s.rate[1] * vessel.mass
    return 0.0


@inner
def kinetic(vessel, s):
    """Kinetic energy (J)."""
    return 0.5 * vessel.mass * s.v[0, vessel.node] ** 2


@inner
def power(vessel, s):
    """Power dissipated into water and air; supplied by their motion, wave drift and thrusters (W)."""
    v = s.v[0, vessel.node]
    water, past, _ = _pressure(vessel.hull, vessel.current, v)
    air, blown, _ = _pressure(vessel.area, vessel.wind, v)
    s.flow[0] += water * past + air * blown
    thrust, _ = _thrust(vessel, s)
    s.flow[1] += water * vessel.current[0] + air * vessel.wind[0] + (vessel.drift + thrust) * v
    return 0.0


@inner
def probe(vessel, s):
    """Report speed, the riser's force on the platform, environment and thrust."""
    k = vessel.probe
    thrust, _ = _thrust(vessel, s)
    s.probe[k] = s.v[0, vessel.node]
    s.probe[k + 1] = s.ends[0, 1, 0] + s.ends[1, 1, 0]
    s.probe[k + 2] = _environment(vessel, s)
    s.probe[k + 3] = thrust
    return 0.0


register(
    Vessel,
    device=force,
    tangent=tangent,
    device_inertia=inertia,
    mass=mass,
    kinetic=kinetic,
    power=power,
    probe=probe,
)
