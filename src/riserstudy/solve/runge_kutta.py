r"""Diagonally implicit Runge-Kutta stepping with an explicit first stage, stiffly accurate.

Stage i balances all forces at the time :math:`t + c_i h`,

.. math::

   I(r_i, a_i) + F(r_i, v_i) = 0,\qquad r_i = r_0 + h \sum_{j \le i} A_{ij} v_j,\qquad
   v_i = v_0 + h \sum_{j \le i} A_{ij} a_j,\qquad q_i = q_0 + h \sum_{j \le i} A_{ij} G_j

with the internal variables q of effects, and the last stage is the step. All implicit stages share their
diagonal element, so a stage is solved like a step of Newmark's method. TR-BDF2 (Bank et al. 1985) is of
second order; ESDIRK4 (Kennedy and Carpenter 2003, the implicit half of ARK4(3)6L[2]SA) is of fourth order.
Both completely damp frequencies that the step does not resolve.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.solve.evaluate import move
from riserstudy.solve.jit import inner, kernel
from riserstudy.solve.newton import Tolerance, account, balance, correct, new_memory
from riserstudy.solve.pace import LENGTH, advance, halve, new_pace, under_way
from riserstudy.solve.program import call_all
from riserstudy.solve.state import (
    ACCELERATION,
    DISSIPATED,
    SUPPLIED,
    VELOCITY,
    Before,
    copy,
    keep,
    know_internal,
    restore,
)
from riserstudy.solve.sums import DONE, NOT_CONVERGED, STOPPED, enter
from riserstudy.solve.write_down import note_start, note_step


class Tableau(NamedTuple):
    """Weights of the stages, (stages, stages): A of the header, its last row the step; and the order."""

    weights: np.ndarray
    order: int


def _tableau(order: int, rows: list[list[float]]) -> Tableau:
    return Tableau(np.array(rows), order)


_G = 1.0 - sqrt(0.5)
#: methods by their names in scenes; tests check the order of every method in this table
TABLEAUS = {
    "TR-BDF2": _tableau(2, [[0.0, 0.0, 0.0], [_G, _G, 0.0], [sqrt(0.125), sqrt(0.125), _G]]),
    "ESDIRK4": _tableau(
        4,
        [
            [0.0] * 6,
            [1 / 4, 1 / 4, 0.0, 0.0, 0.0, 0.0],
            [8611 / 62500, -1743 / 31250, 1 / 4, 0.0, 0.0, 0.0],
            [5012029 / 34652500, -654441 / 2922500, 174375 / 388108, 1 / 4, 0.0, 0.0],
            [
                15267082809 / 155376265600,
                -71443401 / 120774400,
                730878875 / 902184768,
                2285395 / 8070912,
                1 / 4,
                0.0,
            ],
            [82889 / 524892, 0.0, 15625 / 83664, 69875 / 102672, -2260 / 8211, 1 / 4],
        ],
    ),
}
SUPPORTS, INERTIA = 2, 3  # entries of power of a stage, after those of `flow`


class Stages(NamedTuple):
    """Parameters of one run."""

    weights: np.ndarray  # (stages, stages) A of the header, its last row the step
    step: float  # (s)
    steps: int
    tolerance: Tolerance
    iterations: int  # largest number of Newton iterations in a stage
    halvings: int  # largest number of halvings of a time step that fails
    start: int  # time steps that a graded start replaces by three times their number, 0 for none


@inner
def _inertial_power(s):
    """Power of the inertial forces (W)."""
    power = 0.0
    for c in range(len(s.dim)):
        for i in range(s.r.shape[1]):
            power += s.force[c, i] * s.v[c, i]
        # of the mass that does not have the first-order motion
        power -= s.carried[3, c] * s.carried[1, c]
    return power


@inner
def _predict(s, r0, v, a, weights, i, h, ahead):
    """Predict the state of stage i by its sums, with accelerations extrapolated by the factor ``ahead``."""
    # loops over nodes are the innermost ones, so that the compiler uses vector instructions
    step, before = h * weights[i, i], max(i - 2, 0)
    for c in range(s.r.shape[0]):
        for k in range(s.r.shape[1]):
            s.r[c, k], s.v[c, k] = r0[c, k], v[0, c, k]
        for j in range(i):
            share = h * weights[i, j]
            for k in range(s.r.shape[1]):
                s.r[c, k] += share * v[j, c, k]
                s.v[c, k] += share * a[j, c, k]
        for k in range(s.r.shape[1]):
            guess = a[i - 1, c, k] + ahead * (a[i - 1, c, k] - a[before, c, k])
            s.a[c, k] = guess
            s.v[c, k] += step * guess
            s.r[c, k] += step * s.v[c, k]


@inner
def _foresee(now, carried, weights, i, h, ahead):
    """Predict the first-order motion by the sums of stage i; `move` then replaces this prediction."""
    step = h * weights[i, i]
    for k in range(now.shape[1]):
        place, speed = carried[0, 0, k], carried[0, 1, k]
        for j in range(i):
            place += h * weights[i, j] * carried[j, 1, k]
            speed += h * weights[i, j] * carried[j, 2, k]
        last, before = carried[i - 1, 2, k], carried[max(i - 2, 0), 2, k]
        now[2, k] = last + ahead * (last - before)
        now[1, k] = speed + step * now[2, k]
        now[0, k] = place + step * now[1, k]


@inner
def _known(s, internal0, rates, weights, i, h):
    """Internal variables by the sums of stage i, without the contribution of the stage's own rate."""
    s.internal_share[0] = h * weights[i, i]
    for k in range(s.internal.shape[0]):
        for node in range(s.internal.shape[1]):
            known = internal0[k, node]
            for j in range(i):
                known += h * weights[i, j] * rates[j, k, node]
            s.internal_known[k, node] = known


@inner
def _times(weights):
    """Time of each stage, as a share of the step."""
    reached = np.zeros(weights.shape[0])
    for i in range(weights.shape[0]):
        for j in range(i + 1):
            reached[i] += weights[i, j]
    return reached


@inner
def _powers(p, s, force, fixed, power):
    """Powers of a stage (W) into ``power``, after its forces balance."""
    power[SUPPORTS] = account(p, s, force, fixed)
    power[DISSIPATED], power[SUPPLIED] = s.flow[DISSIPATED], s.flow[SUPPLIED]
    power[INERTIA] = _inertial_power(s)


@inner
def _enter(sums, power, weights, h, gained):
    """Add one step: works by the quadrature of the method, for ``gained`` kinetic energy (J)."""
    last = weights.shape[0] - 1
    lost, given, held, numerical = 0.0, 0.0, 0.0, -gained
    for i in range(weights.shape[0]):
        weight = h * weights[last, i]
        lost += weight * power[i, DISSIPATED]
        given += weight * power[i, SUPPLIED]
        held += weight * power[i, SUPPORTS]
        numerical -= weight * power[i, INERTIA]
    enter(sums, held, given, lost, numerical)


@kernel
def march_in_stages(p, s, so, method, fixed, record, sums):
    """March from the state ``s`` at time ``s.clock[0]``; arguments and result are as in `march`."""
    nb = len(s.dof)
    n = s.r.shape[1] - 1  # the last node, loose ones included
    weights = method.weights
    stages = weights.shape[0]
    last = stages - 1
    diagonal = weights[last, last]
    reached = _times(weights)

    out, work = np.zeros((n + 1, nb)), np.zeros((n + 1, nb * nb))
    r0, moment0, force = np.zeros(s.r.shape), np.zeros(s.moment.shape), np.zeros(s.r.shape)
    carried = np.zeros((stages, *s.carried.shape))
    v, a = np.zeros((stages, *s.r.shape)), np.zeros((stages, *s.r.shape))
    internal0 = np.zeros(s.internal.shape)
    rates = np.zeros((stages, *s.internal.shape))
    before = Before(r0, v[0], a[0], moment0, carried[0], internal0, rates[0])
    power = np.zeros((stages, 4))

    memory, pace = new_memory(), new_pace(method)
    know_internal(s)
    balance(p, s, out, work, fixed)
    _powers(p, s, force, fixed, power[last])
    kinetic0 = call_all(p.kinetic, s)
    begin = s.clock[0]
    note_start(p, s, record, begin)

    while under_way(pace, method):
        if sums.stop[0] != 0:
            return STOPPED
        t, h = s.clock[0], pace[LENGTH]
        keep(s, before)
        for k in range(4):
            power[0, k] = power[last, k]
        s.rate[VELOCITY] = 1.0 / (diagonal * h)
        s.rate[ACCELERATION] = s.rate[VELOCITY] * s.rate[VELOCITY]
        failed = False
        for i in range(1, stages):
            ahead = 0.0  # factor of the linear extrapolation of accelerations
            if i > 1:
                ahead = (reached[i] - reached[i - 1]) / (reached[i - 1] - reached[i - 2])
            _predict(s, r0, v, a, weights, i, h, ahead)
            _foresee(s.carried, carried, weights, i, h, ahead)
            _known(s, internal0, rates, weights, i, h)
            move(p, s, t + reached[i] * h)
            if not correct(p, s, method.tolerance, method.iterations, memory, out, work, fixed, sums):
                failed = True
                break
            copy(v[i], s.v)
            copy(a[i], s.a)
            copy(carried[i], s.carried)
            # of a stage without weight in the step, only the rates of internal variables are needed
            if weights[last, i] != 0.0 or s.internal.shape[0] > 0:
                _powers(p, s, force, fixed, power[i])
            copy(rates[i], s.internal_rate)
        if failed:
            restore(s, before)
            for k in range(4):
                power[last, k] = power[0, k]
            if not halve(p, s, t, pace, method, memory, sums):
                return NOT_CONVERGED
            continue

        know_internal(s)
        kinetic1 = call_all(p.kinetic, s)
        _enter(sums, power, weights, h, kinetic1 - kinetic0)
        kinetic0 = kinetic1
        note_step(p, s, so, before, t, h, record)
        advance(s, pace, method, begin)
    return DONE
