r"""Prescribed motion of the platform: harmonic, constant velocity, or a time series.

Over a ramp of the duration P, harmonic motion is multiplied by :math:`r(t) = \tfrac12 (1 - \cos \pi t/P)`. A
cruise is a motion with constant velocity; its speed increases linearly over its ramp. A time series is
interpolated by a cubic spline. The derivatives of the spline give velocity and acceleration.

The motions of a cruising platform in waves follow the wave at the present place of the platform. After the
cruise over the distance x(t), the phase of a wave component is :math:`\omega t - \kappa x(t) + \varphi`,
where :math:`\kappa` is the wave number along the cruise.

References
----------
Elementary: kinematics of a point.
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register, taken_out
from riserstudy.solve.elementary import sine_and_cosine
from riserstudy.solve.jit import inner, kernel
from riserstudy.solve.state import ENDED


class Position(NamedTuple):
    """Displacement at rest."""

    displacement: np.ndarray  # (6,) (m or rad)


class Harmonic(NamedTuple):
    """Sum of harmonic motions."""

    motion: np.ndarray  # (k,) which of surge, sway, heave, roll, pitch, yaw
    amplitude: np.ndarray  # (k,) (m or rad)
    frequency: np.ndarray  # (k,) (rad/s)
    phase: np.ndarray  # (k,) motion is amplitude sin(frequency t + phase) (rad)
    ramp: np.ndarray  # (k,) (s), 0 for none


class Encountered(NamedTuple):
    """Sum of motions of a cruising platform, in the waves that it encounters."""

    motion: np.ndarray  # (k,) as in `Harmonic`
    amplitude: np.ndarray  # (k,) (m or rad)
    frequency: np.ndarray  # (k,) of the wave at a fixed place (rad/s)
    phase: np.ndarray  # (k,) at the start of the cruise (rad)
    ramp: np.ndarray  # (k,) of the motions (s), 0 for none
    delay: np.ndarray  # (k,) wave number along the cruise (rad/m)
    speed: float  # of the cruise (m/s)
    over: float  # ramp of the cruise (s), 0 for none


class Cruise(NamedTuple):
    """Constant velocity after a linear ramp."""

    motion: int
    speed: float  # (m/s)
    ramp: float  # (s), 0 for none


class Series(NamedTuple):
    """A motion given by a cubic spline."""

    motion: int
    time: np.ndarray  # (k,) knots (s)
    coefficient: np.ndarray  # (4, k-1) from the cubic term down, about the left knot


@inner
def drive_position(position, s):
    """Add the displacement at rest."""
    for c in range(6):
        s.platform[0, c] += position.displacement[c]
    return 0.0


@inner
def drive_harmonic(harmonic, s):
    """Add displacement, velocity, acceleration of the harmonic motions."""
    motion, frequency, ramp = harmonic.motion, harmonic.frequency, harmonic.ramp
    t, first = s.clock[0], 0
    while first < motion.shape[0]:
        after = first  # end of a group with the same motion and ramp, which is summed together
        while after < motion.shape[0] and motion[after] == motion[first] and ramp[after] == ramp[first]:
            after += 1
        place = speed = acceleration = 0.0
        for k in range(first, after):
            sine, cosine = sine_and_cosine(frequency[k] * t + harmonic.phase[k])
            place += harmonic.amplitude[k] * sine
            speed += harmonic.amplitude[k] * frequency[k] * cosine
            acceleration -= harmonic.amplitude[k] * frequency[k] * frequency[k] * sine
        grown, rate, bend = 1.0, 0.0, 0.0
        if t < ENDED * ramp[first]:
            p = pi / ramp[first]
            grown = 0.5 * (1.0 - cos(p * t))
            rate, bend = 0.5 * p * sin(p * t), 0.5 * p * p * cos(p * t)
        m = motion[first]
        s.platform[0, m] += place * grown
        s.platform[1, m] += speed * grown + place * rate
        s.platform[2, m] += acceleration * grown + 2.0 * speed * rate + place * bend
        first = after
    return 0.0


@kernel
def _sailed(speed, ramp, t):
    """Distance of the cruise (m), its speed and acceleration; also called from plain Python."""
    if t < ENDED * ramp:
        return 0.5 * speed * t * t / ramp, speed * t / ramp, speed / ramp
    if t > 0.0:
        return speed * (t - 0.5 * ramp), speed, 0.0
    return 0.0, 0.0, 0.0


@inner
def drive_encountered(met, s):
    """Add displacement, velocity and acceleration of the motions in the encountered waves."""
    t = s.clock[0]
    way, fast, gain = _sailed(met.speed, met.over, t)
    for k in range(met.motion.shape[0]):
        rate = met.frequency[k] - met.delay[k] * fast
        sine, cosine = sine_and_cosine(met.frequency[k] * t + met.phase[k] - met.delay[k] * way)
        place = met.amplitude[k] * sine
        speed = met.amplitude[k] * rate * cosine
        bend = -met.amplitude[k] * (rate * rate * sine + met.delay[k] * gain * cosine)
        grown, growth, turn = 1.0, 0.0, 0.0
        if t < ENDED * met.ramp[k]:
            p = pi / met.ramp[k]
            grown = 0.5 * (1.0 - cos(p * t))
            growth, turn = 0.5 * p * sin(p * t), 0.5 * p * p * cos(p * t)
        m = met.motion[k]
        s.platform[0, m] += place * grown
        s.platform[1, m] += speed * grown + place * growth
        s.platform[2, m] += bend * grown + 2.0 * speed * growth + place * turn
    return 0.0


@inner
def drive_cruise(cruise, s):
    """Add the distance of the cruise, its speed and acceleration."""
    m = cruise.motion
    way, speed, gain = _sailed(cruise.speed, cruise.ramp, s.clock[0])
    s.platform[0, m] += way
    s.platform[1, m] += speed
    s.platform[2, m] += gain
    return 0.0


@inner
def drive_series(series, s):
    """Add the spline's value and derivatives; before and after its times, the platform is at rest."""
    t, m, c = s.clock[0], series.motion, series.coefficient
    last = series.time.shape[0] - 1
    inside = min(max(t, series.time[0]), series.time[last])
    k = min(max(np.searchsorted(series.time, inside, side="right") - 1, 0), last - 1)
    x = inside - series.time[k]
    s.platform[0, m] += ((c[0, k] * x + c[1, k]) * x + c[2, k]) * x + c[3, k]
    if inside == t:
        s.platform[1, m] += (3.0 * c[0, k] * x + 2.0 * c[1, k]) * x + c[2, k]
        s.platform[2, m] += 6.0 * c[0, k] * x + 2.0 * c[1, k]
    return 0.0


register(Position, Called("platform position", "platform.position"), motion=drive_position)
register(
    Harmonic,
    Called(
        "platform motion",
        "platform",
        (
            taken_out("surge", "platform.surge", "dynamics"),
            taken_out("sway", "platform.sway", "dynamics"),
            taken_out("heave", "platform.heave", "dynamics"),
            taken_out("roll", "platform.roll", "dynamics"),
            taken_out("pitch", "platform.pitch", "dynamics"),
            taken_out("yaw", "platform.yaw", "dynamics"),
            taken_out("cruise", "platform.cruise", "dynamics"),
            taken_out("platform response", "platform.response"),
        ),
    ),
    motion=drive_harmonic,
)
register(Encountered, "platform motion", motion=drive_encountered)
register(Cruise, "platform motion", motion=drive_cruise)
register(Series, "platform motion", motion=drive_series)
