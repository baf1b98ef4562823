r"""Lock-in: the phase of a vortex force synchronises with the riser's motion in the direction of the force.

The phase advances with a frequency that is :math:`\hat f` times the flow speed divided by the diameter of the
pipe. If force and velocity are in phase, :math:`\hat f` is the value :math:`f_0` of a pipe at rest. Otherwise
:math:`\hat f` increases or decreases, which brings force and velocity into phase,

.. math:: \dot\varphi = 2\pi\,\hat f(\theta)\,|u|/D,\qquad
          \hat f = f_0 + (f_{max} - f_0)\sin\theta\ (\theta > 0),\qquad
          \hat f = f_0 + (f_0 - f_{min})\sin\theta\ (\theta < 0),

Here y' is the velocity along the force, and :math:`\theta` is the phase of y' minus :math:`\varphi`. The
phase of y' is computed from velocity and acceleration, each divided by its running root mean square,

.. math:: \sin\theta = \frac{r\cos\varphi - p\sin\varphi}{\sqrt{p^2 + r^2 + \delta^2}},\quad
          p = \frac{y'}{\sqrt{s_v + (\varepsilon |u|)^2}},\quad
          r = \frac{-y''}{\sqrt{s_a + (\varepsilon |u|\,\omega_0)^2}},\quad
          \dot s_v = \frac{y'^2 - s_v}{T D/|u|},\ \dot s_a = \frac{y''^2 - s_a}{T D/|u|}

The frequency :math:`\omega_0` is :math:`2\pi f_0 |u|/D`; :math:`s_v` and :math:`s_a` are the running mean
squares of velocity and acceleration. Without motion, the phase of y' is not defined; :math:`\varepsilon` and
:math:`\delta` then make :math:`\sin\theta` zero. At velocities of one hundredth of the flow speed,
:math:`\varepsilon` and :math:`\delta` change :math:`\sin\theta` by less than one per cent.

The phase and both mean squares of each node are internal variables of the model.

References
----------
Thorsen, Sævik and Larsen (2014), "A simplified method for time domain simulation of cross-flow
vortex-induced vibrations", *Journal of Fluids and Structures* 49, 135-148: the model, except for the limits
without motion.
"""

from __future__ import annotations

from math import cos, pi, sin, sqrt

from riserstudy.solve.jit import inner
from riserstudy.solve.state import ENDED
from riserstudy.solve.vec import at, dot, mul, norm, sub

PHASE, OF_VELOCITY, OF_ACCELERATION = 0, 1, 2  # rows of a node's internal variables
VARIABLES = 3  # number of these rows
FREE, FALL, RISE, MEMORY = (0, 1, 2, 3)  # rows of a record's ``shedding``: f_0, f_0 - f_min, f_max - f_0, T
STILL = 1e-9  # (m/s) flow speed below which no vortices are shed
# epsilon: ratio of the pipe's velocity to the flow speed below which the pipe counts as at rest
LEAST = 1e-3
FLAT = 0.05  # delta
MOST = 30  # largest number of iterations of a phase
ROUNDING = 1e-13  # tolerance of a phase (rad)


@inner
def grown(record, s):
    """Share of the force that acts at this time, by the ramp; zero in statics."""
    t = s.clock[0]
    if t <= 0.0:
        return 0.0
    return 1.0 if t >= ENDED * record.ramp else 0.5 * (1.0 - cos(pi * t / record.ramp))


@inner
def past(s, i):
    """Relative velocity of the water across the pipe, and its magnitude."""
    w, t = sub(at(s.dim, s.water, i), at(s.dim, s.v, i)), at(s.dim, s.direction, i)
    u = sub(w, mul(dot(w, t), t))
    return u, norm(u)


@inner
def rest(record, s, i):
    """Keep a node's internal variables constant, because no vortices are shed there."""
    for k in range(record.first, record.first + VARIABLES):
        s.internal[k, i] = s.internal_known[k, i]
        s.internal_rate[k, i] = 0.0
    return 0.0


@inner
def _mean_square(record, s, row, i, value, speed):
    """A running mean square, and the weight of the present value in it."""
    rate = speed / (record.shedding[MEMORY, i] * record.diameter[i])
    share = s.internal_share[0] * rate
    mean = (s.internal_known[row, i] + share * value * value) / (1.0 + share)
    s.internal[row, i] = mean
    s.internal_rate[row, i] = rate * (value * value - mean)
    return mean, share / (1.0 + share)


@inner
def synchronise(record, s, i, speed, y_v, y_a):
    """Solve for the internal variables of a node, and compute the derivatives of its phase.

    Parameters
    ----------
    record : record of the force, with ``diameter`` and ``shedding`` at the nodes, and ``first``, the first
        row of its internal variables.
    speed : relative speed of the water across the pipe (m/s).
    y_v, y_a : velocity (m/s) and acceleration (m/s2) of the pipe along the force.

    Returns
    -------
    Derivatives of the phase by velocity and acceleration along the force, and by the speed past the pipe.
    """
    f0, turn = record.shedding[FREE, i], 2.0 * pi * speed / record.diameter[i]
    mean_v, mine = _mean_square(record, s, record.first + OF_VELOCITY, i, y_v, speed)
    mean_a, _ = _mean_square(record, s, record.first + OF_ACCELERATION, i, y_a, speed)
    least = LEAST * speed
    # stages of high order may make a mean square of zero slightly negative
    square_v = max(mean_v, 0.0) + least * least
    square_a = max(mean_a, 0.0) + (least * f0 * turn) ** 2
    p, r = y_v / sqrt(square_v), -y_a / sqrt(square_a)
    size = sqrt(p * p + r * r + FLAT * FLAT)

    share, row = s.internal_share[0], record.first + PHASE
    known = s.internal_known[row, i]
    phase = known + share * s.internal_rate[row, i]  # first guess: with the previous rate
    for _ in range(MOST):
        c, sine = cos(phase), sin(phase)
        slip = (r * c - p * sine) / size
        gain = record.shedding[RISE, i] if slip > 0.0 else record.shedding[FALL, i]
        rate = turn * (f0 + gain * slip)
        damping = 1.0 + share * turn * gain * (r * sine + p * c) / size
        change = (known + share * rate - phase) / damping
        phase += change
        if abs(change) <= ROUNDING * (1.0 + abs(phase)):
            break
    c, sine = cos(phase), sin(phase)
    slip = (r * c - p * sine) / size
    gain = record.shedding[RISE, i] if slip > 0.0 else record.shedding[FALL, i]
    s.internal[row, i] = phase
    s.internal_rate[row, i] = turn * (f0 + gain * slip)
    if share == 0.0:
        return 0.0, 0.0, 0.0

    # derivatives of the phase: by p and r, and of p and r by motion and speed
    damping = 1.0 + share * turn * gain * (r * sine + p * c) / size
    by_p = share * turn * gain * (-sine - slip * p / size) / size / damping
    by_r = share * turn * gain * (c - slip * r / size) / size / damping
    p_by_y = (1.0 - p * mine * y_v / sqrt(square_v)) / sqrt(square_v)
    r_by_y = -(1.0 + r * mine * y_a / sqrt(square_a)) / sqrt(square_a)
    p_by_speed = -p * (mine * (y_v * y_v - mean_v) / speed + 2.0 * least * LEAST) / (2.0 * square_v)
    slow = (LEAST * f0 * turn) ** 2 * speed
    r_by_speed = -r * (mine * (y_a * y_a - mean_a) / speed + 4.0 * slow) / (2.0 * square_a)
    by_speed = by_p * p_by_speed + by_r * r_by_speed + share * turn / speed * (f0 + gain * slip) / damping
    return by_p * p_by_y, by_r * r_by_y, by_speed
