r"""Vortex-induced vibration across the flow: lift whose phase is drawn to that of the riser's own motion.

Vortices shed from a pipe lift it across the water that flows past. With the velocity u of the water across
the pipe, seen from it, the pipe's tangent t and :math:`n = u/|u|`, the lift per unstretched length is

.. math:: f = \tfrac12 \rho\,C_v D\,|u|\,(t \times u)\cos\varphi,\qquad
          \dot\varphi = 2\pi\,\hat f(\theta)\,|u|/D .

The frequency :math:`\hat f` over speed and diameter is that of a pipe at rest where force and velocity are
in phase, and rises or falls to bring them in phase,

.. math:: \hat f = f_0 + (f_{max} - f_0)\sin\theta\ (\theta > 0),\qquad
          \hat f = f_0 + (f_0 - f_{min})\sin\theta\ (\theta < 0),

with :math:`\theta` the phase of the velocity across the flow, :math:`y' = v\cdot e` with
:math:`e = t \times n`, less :math:`\varphi`. That phase is taken from velocity and acceleration, either over
its own running root mean square,

.. math:: \sin\theta = \frac{r\cos\varphi - p\sin\varphi}{\sqrt{p^2 + r^2 + \delta^2}},\quad
          p = \frac{y'}{\sqrt{s_v + (\varepsilon |u|)^2}},\quad
          r = \frac{-y''}{\sqrt{s_a + (\varepsilon |u|\,\omega_0)^2}},\quad
          \dot s_v = \frac{y'^2 - s_v}{T D/|u|},\ \dot s_a = \frac{y''^2 - s_a}{T D/|u|}

with :math:`\omega_0 = 2\pi f_0 |u|/D`. Without motion :math:`\varepsilon` and :math:`\delta` make
:math:`\sin\theta` zero instead of leaving the phase of nothing to decide; where velocities are a hundredth of
the flow's they change it by less than one per cent.

The phase and both mean squares of each node are internal variables of the model. Lift never takes energy from
the flow that it does not give to the riser: across what flows past, seen from the riser, it does no work.
How loads turn with the pipe, and how phases follow elevation, is left out of the tangent: in motion both are
small beside inertia.

References
----------
Thorsen, Sævik and Larsen (2014), "A simplified method for time domain simulation of cross-flow
vortex-induced vibrations", *Journal of Fluids and Structures* 49, 135-148: the model, but for the limits
where nothing moves.
"""

from __future__ import annotations

from math import cos, pi, sin, sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register, taken_out
from riserstudy.solve.jit import inner
from riserstudy.solve.spread import spread_and_keep, spread_stiffness
from riserstudy.solve.state import ACCELERATION, ENDED, OTHER, OWN, SUPPLIED, VELOCITY
from riserstudy.solve.vec import add, at, cross, dot, mul, norm, outer, put, put_block, sub, upward

PHASE, OF_VELOCITY, OF_ACCELERATION = 0, 1, 2  # rows of a node's internal variables
VARIABLES = 3  # of them
FREE, FALL, RISE, MEMORY = 0, 1, 2, 3  # rows of `VortexLift.shedding`
STILL = 1e-9  # (m/s) slower water sheds nothing
LEAST = 1e-3  # epsilon: velocity over that of the flow below which motion is none
FLAT = 0.05  # delta
MOST = 30  # iterations of a phase
ROUNDING = 1e-13  # of a phase (rad)


class VortexLift(NamedTuple):
    """Lift of the segments that shed vortices."""

    low: np.ndarray  # (n,) rho C_v D / 2 times length, as it loads the lower node (kg/m)
    up: np.ndarray  # (n,) as it loads the upper node
    force: np.ndarray  # (d, n+1) scratch: lift on the nodes (N)
    diameter: np.ndarray  # (n+1,) D at the nodes (m), 0 where nothing is shed
    shedding: np.ndarray  # (4, n+1) f_0, f_0 - f_min, f_max - f_0, T (1)
    ramp: float  # time over which the lift comes up (s)
    first: int  # row of the phases among the internal variables
    follow: (
        np.ndarray
    )  # (3, n+1) scratch: phase by velocity along e, along n, by acceleration along e


@inner
def _grown(lift, s):
    """Share of the lift that acts; none in statics, which are before all motion."""
    t = s.clock[0]
    if t <= 0.0:
        return 0.0
    return 1.0 if t >= ENDED * lift.ramp else 0.5 * (1.0 - cos(pi * t / lift.ramp))


@inner
def _past(s, i):
    """Velocity of the water across the pipe, seen from it, and its size."""
    w, t = sub(at(s.dim, s.water, i), at(s.dim, s.v, i)), at(s.dim, s.direction, i)
    u = sub(w, mul(dot(w, t), t))
    return u, norm(u)


@inner
def internal(lift, s):
    """Phases and mean squares of the nodes, their rates, and how the phases follow the motion."""
    for i in range(s.l0.shape[0] + 1):
        for k in range(VARIABLES):
            lift.follow[k, i] = 0.0
        u, speed = _past(s, i)
        if lift.diameter[i] > 0.0 and speed > STILL:
            _shed(lift, s, i, mul(1.0 / speed, u), speed)
        else:
            for k in range(lift.first, lift.first + VARIABLES):
                s.internal[k, i] = s.internal_known[k, i]
                s.internal_rate[k, i] = 0.0
    return 0.0


@inner
def _mean_square(lift, s, row, i, value, speed):
    """A running mean square and the share of it that is this value's."""
    rate = speed / (lift.shedding[MEMORY, i] * lift.diameter[i])
    share = s.internal_share[0] * rate
    mean = (s.internal_known[row, i] + share * value * value) / (1.0 + share)
    s.internal[row, i] = mean
    s.internal_rate[row, i] = rate * (value * value - mean)
    return mean, share / (1.0 + share)


@inner
def _shed(lift, s, i, n, speed):
    """What `internal` does at a node whose water flows along ``n``."""
    e = cross(at(s.dim, s.direction, i), n)
    v, a = at(s.dim, s.v, i), at(s.dim, s.a, i)
    y_v, y_a = dot(v, e), dot(a, e)
    f0, turn = lift.shedding[FREE, i], 2.0 * pi * speed / lift.diameter[i]
    mean_v, mine = _mean_square(lift, s, lift.first + OF_VELOCITY, i, y_v, speed)
    mean_a, _ = _mean_square(lift, s, lift.first + OF_ACCELERATION, i, y_a, speed)
    least = LEAST * speed
    # stages of high order may leave a little less than nothing of a mean square that was none
    square_v = max(mean_v, 0.0) + least * least
    square_a = max(mean_a, 0.0) + (least * f0 * turn) ** 2
    p, r = y_v / sqrt(square_v), -y_a / sqrt(square_a)
    size = sqrt(p * p + r * r + FLAT * FLAT)

    share, row = s.internal_share[0], lift.first + PHASE
    known = s.internal_known[row, i]
    phase = known + share * s.internal_rate[row, i]  # as fast as last
    for _ in range(MOST):
        c, sine = cos(phase), sin(phase)
        slip = (r * c - p * sine) / size
        gain = lift.shedding[RISE, i] if slip > 0.0 else lift.shedding[FALL, i]
        rate = turn * (f0 + gain * slip)
        damping = 1.0 + share * turn * gain * (r * sine + p * c) / size
        change = (known + share * rate - phase) / damping
        phase += change
        if abs(change) <= ROUNDING * (1.0 + abs(phase)):
            break
    c, sine = cos(phase), sin(phase)
    slip = (r * c - p * sine) / size
    gain = lift.shedding[RISE, i] if slip > 0.0 else lift.shedding[FALL, i]
    s.internal[row, i] = phase
    s.internal_rate[row, i] = turn * (f0 + gain * slip)
    if share == 0.0:
        return

    # how the phase follows: by p and r, then these by motion across and along the flow
    damping = 1.0 + share * turn * gain * (r * sine + p * c) / size
    by_p = share * turn * gain * (-sine - slip * p / size) / size / damping
    by_r = share * turn * gain * (c - slip * r / size) / size / damping
    along, along_a = dot(v, n), dot(a, n)
    # dy_v = (1 + v.n / speed) (e.dv), dy_a = e.da + (a.n / speed) (e.dv), d speed = -n.dv
    stretch, lean = 1.0 + along / speed, along_a / speed
    p_by_y = (1.0 - p * mine * y_v / sqrt(square_v)) / sqrt(square_v)
    r_by_y = -(1.0 + r * mine * y_a / sqrt(square_a)) / sqrt(square_a)
    p_by_speed = -p * (mine * (y_v * y_v - mean_v) / speed + 2.0 * least * LEAST) / (2.0 * square_v)
    slow = (LEAST * f0 * turn) ** 2 * speed
    r_by_speed = -r * (mine * (y_a * y_a - mean_a) / speed + 4.0 * slow) / (2.0 * square_a)
    lift.follow[0, i] = by_p * p_by_y * stretch + by_r * r_by_y * lean
    lift.follow[1, i] = -(
        by_p * p_by_speed + by_r * r_by_speed + share * turn / speed * (f0 + gain * slip) / damping
    )
    lift.follow[2, i] = by_r * r_by_y


@inner
def force(lift, s):
    """Lift on the nodes."""
    grown = _grown(lift, s)
    for i in range(s.l0.shape[0] + 1):
        u, speed = _past(s, i)
        size = grown * speed * cos(s.internal[lift.first + PHASE, i])
        put(s.density, i, mul(size, cross(at(s.dim, s.direction, i), u)))
    spread_and_keep(s, lift.low, lift.up, OWN, OTHER, s.density, lift.force, s.force)
    return 0.0


@inner
def tangent(lift, s):
    """Derivative by velocity and acceleration, phases included, and by elevation in sheared water."""
    grown, up = _grown(lift, s), upward(s.dim)
    if grown == 0.0:
        return 0.0
    by_v, by_a = s.rate[VELOCITY], s.rate[ACCELERATION]
    for i in range(s.l0.shape[0] + 1):
        u, speed = _past(s, i)
        t = at(s.dim, s.direction, i)
        n = mul(1.0 / max(speed, STILL), u)
        e = cross(t, n)
        phase, h = s.internal[lift.first + PHASE, i], at(s.dim, s.shear, i)
        c, sine = grown * speed * cos(phase), grown * speed * speed * sin(phase)
        across = sub(mul(2.0 * by_v * c, outer(e, n)), mul(by_v * c, outer(n, e)))
        by_height = sub(mul(2.0 * c * dot(n, h), e), mul(c * dot(e, h), n))
        follows = add(
            mul(by_v * lift.follow[0, i] + by_a * lift.follow[2, i], e),
            mul(by_v * lift.follow[1, i], n),
        )
        block = add(across, mul(sine, outer(e, follows)))
        put_block(s.block, i, sub(block, outer(by_height, up)))
    spread_stiffness(s, lift.low, lift.up, OWN, OTHER)
    return 0.0


@inner
def power(lift, s):
    """Power that the water supplies (W); after ``force``."""
    for i in range(s.l0.shape[0] + 1):
        s.flow[SUPPLIED] += dot(at(s.dim, lift.force, i), at(s.dim, s.v, i))
    return 0.0


register(
    VortexLift,
    Called(
        "vortex-induced vibration",
        "riser.viv",
        (taken_out("vortex-induced vibration", "riser[*].viv", "lateral"),),
        example={
            "riser[0].viv": {"model": "synchronisation", "diameter": "0.5 m", "coefficient": 1.2}
            | {"frequencies": [0.11, 0.18, 0.26], "memory": 20.0, "seed": 1, "ramp": "0.1 s"}
        },
    ),
    string=force,
    internal=internal,
    tangent=tangent,
    power=power,
)
