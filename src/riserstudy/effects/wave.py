r"""Waves: velocity and acceleration of the water at the nodes by linear (Airy) theory, at any depth.

The sea is a sum of long-crested components that travel in one direction; a regular wave is a single
component. With the distance x in this direction, the elevation z above the mean level, and :math:`\theta =
k x - \omega t + \varphi`,

.. math::
    \eta = \sum a \cos\theta,\quad
    u = \sum a \omega \frac{\cosh k(z+d)}{\sinh kd} \cos\theta,\quad
    w = \sum a \omega \frac{\sinh k(z+d)}{\sinh kd} \sin\theta

The accelerations are the derivatives of u and w with respect to time. Here :math:`\eta` is the elevation of
the surface, u the horizontal and w the vertical velocity of the water, and d the water depth. Over the ramp,
half a cosine increases the amplitudes of all components from zero. The derivative of the ramp is part of the
acceleration. Up to t = 0 the sea is calm, so the static equilibrium has no waves. The sums are computed
directly, component by component.

Linear theory is valid up to the mean level. For the water above the mean level, there are three options: no
velocity (none), the velocity at the mean level (constant), or a velocity profile that is stretched from
seabed to surface (stretched, Wheeler 1970). Segments that cross the surface have a node above the surface
(`waterline`). At nodes above the surface, the velocity is the velocity at the surface. The wave is evaluated
at the position of a node in the deformed riser. The stiffness matrix omits the change of the wave with
horizontal position.

References
----------
Airy (1845), "Tides and waves", *Encyclopaedia Metropolitana*; Wheeler (1970), "Method for calculating forces
produced by irregular waves", *Journal of Petroleum Technology* 22, 359-367.
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, put_in, register, taken_out
from riserstudy.solve.elementary import exponential, sine_and_cosine, within_a_turn
from riserstudy.solve.jit import inner
from riserstudy.solve.state import ENDED

NONE, CONSTANT, STRETCHED = 0, 1, 2
DEEP = 37.0  # k times depth beyond which exp(-kz) is below rounding
BED, SPEED, ANGLE = 0, 1, 2  # rows of the values of each component at a time


class Wave(NamedTuple):
    """Components of a sea."""

    amplitude: np.ndarray  # (c,) (m)
    frequency: np.ndarray  # (c,) (rad/s)
    number: np.ndarray  # (c,) wave number (rad/m)
    phase: np.ndarray  # (c,) (rad)
    heading: np.ndarray  # (d-1,) unit vector of travel in the horizontal directions
    surface: float  # elevation of the mean level (m)
    depth: float  # of the water (m)
    ramp: float  # (s), 0 for none
    above: int  # NONE, CONSTANT or STRETCHED
    scratch: np.ndarray  # (3, c) exp(-2kd); a w / (1 - exp(-2kd)) (m/s); phase at the time (rad)


@inner
def growth(wave, t):
    """Share of the wave that acts at a time, by the ramp, and its rate."""
    if t <= 0.0:
        return 0.0, 0.0
    if t >= ENDED * wave.ramp:
        return 1.0, 0.0
    p = pi / wave.ramp
    return 0.5 * (1.0 - cos(p * t)), 0.5 * p * sin(p * t)


@inner
def drive(wave, s):
    """Add velocity, its change with elevation, and acceleration of the water at the nodes."""
    up = len(s.dim) - 1
    t = s.clock[0]
    grown, rate = growth(wave, t)
    if grown == 0.0 and rate == 0.0:
        return 0.0
    _at_the_time(wave, t)
    _immerse(wave, s, grown)
    for i in range(s.l0.shape[0] + 1):
        squeeze = s.density[0, i]
        z = (s.r[up, i] - wave.surface + wave.depth) * squeeze - wave.depth
        z = min(z, 0.0) if squeeze > 0.0 else 0.0  # at most the surface, without rounding errors
        along, upwards = _sums(wave, _along(wave, s, i), z)
        slope = squeeze * grown
        for c in range(up):
            s.water[c, i] += wave.heading[c] * grown * along[0]
            s.shear[c, i] += wave.heading[c] * slope * along[1]
            s.water_rate[c, i] += wave.heading[c] * (grown * along[2] + rate * along[0])
        s.water[up, i] += grown * upwards[0]
        s.shear[up, i] += slope * upwards[1]
        s.water_rate[up, i] += grown * upwards[2] + rate * upwards[0]
    return 0.0


@inner
def _at_the_time(wave, t):
    """Compute the values of each component that depend on time but not on position."""
    here = wave.scratch
    for k in range(wave.amplitude.shape[0]):
        bed = exponential(max(-2.0 * wave.number[k] * wave.depth, -2.0 * DEEP))
        here[BED, k] = bed
        here[SPEED, k] = wave.amplitude[k] * wave.frequency[k] / (1.0 - bed)
        here[ANGLE, k] = within_a_turn(wave.phase[k] - wave.frequency[k] * t)


@inner
def _sums(wave, x, z):
    """Velocity, its change with elevation, and its rate, without ramp: along the heading, and upwards."""
    here, number, frequency = wave.scratch, wave.number, wave.frequency
    last = number.shape[0]
    while last > 0 and number[last - 1] * z < -DEEP:
        last -= 1  # the shortest waves are last; their motion is negligible at this depth
    u = u_slope = u_rate = w = w_slope = w_rate = 0.0
    for k in range(last):
        # cosh and sinh k(z+d) over sinh kd, without overflow at any depth
        near = exponential(max(number[k] * z, -DEEP))
        far = here[BED, k] / near
        even, odd = here[SPEED, k] * (near + far), here[SPEED, k] * (near - far)
        sine, cosine = sine_and_cosine(number[k] * x + here[ANGLE, k])
        u += even * cosine
        u_slope += number[k] * odd * cosine
        u_rate += frequency[k] * even * sine
        w += odd * sine
        w_slope += number[k] * even * sine
        w_rate -= frequency[k] * odd * cosine
    return (u, u_slope, u_rate), (w, w_slope, w_rate)


@inner
def _along(wave, s, i):
    """Distance of a node along the heading (m)."""
    x = 0.0
    for c in range(len(s.dim) - 1):
        x += wave.heading[c] * s.r[c, i]
    return x


@inner
def _immerse(wave, s, grown):
    """Write the factor on heights above the seabed at the nodes to ``s.density``; 0 above the water.

    The wave elevation above the mean level is added to ``s.level`` if another effect needs it.
    """
    up = len(s.dim) - 1
    components = wave.amplitude.shape[0]
    crest = 0.0
    for k in range(components):
        crest += wave.amplitude[k]
    n = s.l0.shape[0]
    for i in range(n + 1):
        z = s.r[up, i] - wave.surface
        squeeze, wet = 1.0, z <= 0.0
        near = max(z, s.r[up, min(i + 1, n)] - wave.surface) > -crest
        if wave.above == STRETCHED or (wave.above == CONSTANT and near):
            x = _along(wave, s, i)
            eta = 0.0
            for k in range(components):
                _, cosine = sine_and_cosine(wave.number[k] * x + wave.scratch[ANGLE, k])
                eta += wave.amplitude[k] * cosine
            eta *= grown
            s.level[i] += eta
            if wave.above == STRETCHED:
                squeeze, wet = wave.depth / (wave.depth + eta), z < eta
        s.density[0, i] = squeeze if wet else 0.0


register(
    Wave,
    Called(
        "wave",
        "wave",
        (
            taken_out("wave", "wave", "dynamics"),
            put_in(
                "wave",
                "wave",
                {"wave": {"height": "2 m", "period": "8 s", "above_mean_level": "none"}},
                "2 m high, 8 s",
                "dynamics",
                "lateral",
                "levels",
            ),
        ),
    ),
    drive=drive,
)
