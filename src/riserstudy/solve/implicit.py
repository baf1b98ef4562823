r"""Generalised-alpha stepping with Newton's iteration and the analytic tangent.

Forces balance at every step, :math:`I(r_{n+1}, \hat a_{n+1}) + F_{n+1} = 0`, with the true acceleration;
Newmark's formulas run on an auxiliary one that follows it (Arnold and Brüls 2007),

.. math::

   (1-\alpha_m)\,a_{n+1} + \alpha_m a_n = (1-\alpha_f)\,\hat a_{n+1} + \alpha_f \hat a_n .

Where mass is constant this is the method of Chung and Hulbert (1993); where it turns with the pipe, as
added mass does, this form stays second order. alpha_m = alpha_f = 0 is Newmark's method.

A practical step needs one correction: the next would be about C d^2, with d the correction just made and
C from the last step that made two, so a second is made only where that estimate calls for it (half the
run time of always confirming).
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.jit import inner, kernel
from riserstudy.solve.blocktri import solve
from riserstudy.solve.evaluate import forces, inertia, move, tangent
from riserstudy.solve.program import every
from riserstudy.solve.record import evaluate_and_note, interpolate, note, tabulate, widen
from riserstudy.solve.state import clear_tangent

DONE, NOT_CONVERGED = 0, 1
CONFIRM_EVERY = 32  # steps after which C is measured anew
SAFETY = 4.0  # on the estimate C d^2


class Method(NamedTuple):
    """Parameters of one run."""

    alpha_m: float
    alpha_f: float
    beta: float
    gamma: float
    step: float  # (s)
    steps: int
    tolerance: float  # of a position correction, root mean square over nodes (m)
    iterations: int  # Newton iterations a step, at most
    halvings: int  # of a step that fails, at most


def generalised_alpha(rho_inf) -> tuple[float, float, float, float]:
    """alpha_m, alpha_f, beta, gamma for a spectral radius at infinite frequency."""
    alpha_m = (2.0 * rho_inf - 1.0) / (rho_inf + 1.0)
    alpha_f = rho_inf / (rho_inf + 1.0)
    gamma = 0.5 - alpha_m + alpha_f
    return alpha_m, alpha_f, 0.25 * (gamma + 0.5) ** 2, gamma


class Ledger(NamedTuple):
    """What a run adds up."""

    work: np.ndarray  # (5,) J: by supports, by water and devices, dissipated, numerical, exchanged
    count: np.ndarray  # (4,) steps, Newton iterations, halved steps, explicit evaluations
    failure: np.ndarray  # (3,) time (s), node, size of its last correction (m)


def new_ledger() -> Ledger:
    """All zero."""
    return Ledger(np.zeros(5), np.zeros(4, np.int64), np.zeros(3))


@inner
def balance(p, s, out, work, fixed):
    """Accelerations of the free directions from the forces as they are."""
    d = len(s.dim)
    m = len(s.dof) - d
    n = s.l0.shape[0]
    forces(p, s)
    for c in range(d):
        for i in range(n + 1):
            out[i, m + c] = s.force[c, i]
    inertia(p, s)
    for i in range(n + 1):
        for u in range(m):
            out[i, u] = 0.0
        for c in range(d):
            out[i, m + c] += s.force[c, i]
    for f in range(fixed.shape[0]):
        out[fixed[f, 0], fixed[f, 1]] = 0.0
    clear_tangent(s)
    s.rate[0], s.rate[1] = 0.0, 1.0
    every(p.mass, s)
    for i in range(n + 1):
        for c in range(d):
            if s.k_node[i, c * d + c] == 0.0:  # no mass: stays as it is
                s.k_node[i, c * d + c] = 1.0
                out[i, m + c] = 0.0
    solve(s, out, work, fixed)
    for c in range(d):
        for i in range(n + 1):
            s.a[c, i] += out[i, m + c]


@kernel
def march(p, s, so, method, fixed, record, ledger):
    """March from the state ``s`` at time ``s.clock[0]``; outputs go to ``record``.

    ``so`` is a second state of the same model, for evaluations at output times.
    Returns DONE or NOT_CONVERGED (then ``ledger.failure`` tells where).
    """
    d = len(s.dim)
    nb = len(s.dof)
    m = nb - d
    n = s.l0.shape[0]
    am, af, beta, gamma = method.alpha_m, method.alpha_f, method.beta, method.gamma

    out, work = np.zeros((n + 1, nb)), np.zeros((n + 1, nb * nb))
    r0, v0, a0 = np.zeros((d, n + 1)), np.zeros((d, n + 1)), np.zeros((d, n + 1))
    moment0 = np.zeros((m, n + 1))
    force1 = np.zeros((d, n + 1))
    inert0, inert1 = np.zeros((d, n + 1)), np.zeros((d, n + 1))
    flow0 = np.zeros(2)

    curvature = np.inf  # C of the header
    level, left, since = 0, 1, 0
    h = method.step
    k_out = 0
    step = 0

    balance(p, s, out, work, fixed)
    follower = s.a.copy()  # the auxiliary acceleration
    forces(p, s)
    force1[:] = s.force
    inertia(p, s)
    inert1[:] = s.force
    s.flow[:] = 0.0
    every(p.power, s)
    flow0[:] = s.flow
    kinetic0 = every(p.kinetic, s)
    held0 = supplied(s, force1, inert1, fixed)
    start = t = s.clock[0]
    first = record.time[0] - 1e-9 * h  # envelopes start with the outputs
    if first <= t:
        tabulate(s, record.values)
        widen(record)
        note(p, s, record, 0)
        k_out = 1

    while step < method.steps:
        t = s.clock[0]
        r0[:], v0[:], a0[:], moment0[:] = s.r, s.v, s.a, s.moment
        inert0[:] = inert1
        s.rate[0] = gamma / (beta * h)
        s.rate[1] = (1.0 - am) / ((1.0 - af) * beta * h * h)
        for c in range(d):
            for i in range(n + 1):
                s.r[c, i] += h * v0[c, i] + 0.5 * h * h * follower[c, i]
                s.v[c, i] += h * follower[c, i]
                s.a[c, i] = (follower[c, i] - af * a0[c, i]) / (1.0 - af)
        move(p, s, t + h)

        converged = False
        last = 0.0
        worst, where = 0.0, 0
        for iteration in range(method.iterations):
            forces(p, s)
            force1[:] = s.force
            inertia(p, s)
            for i in range(n + 1):
                for u in range(m):
                    out[i, u] = s.turn[u, i]
                for c in range(d):
                    out[i, m + c] = force1[c, i] + s.force[c, i]
            tangent(p, s)
            solve(s, out, work, fixed)
            square, worst = 0.0, 0.0
            for c in range(d):
                for i in range(n + 1):
                    delta = out[i, m + c]
                    s.r[c, i] += delta
                    s.v[c, i] += s.rate[0] * delta
                    s.a[c, i] += s.rate[1] * delta
                    square += delta * delta
                    if not abs(delta) <= worst:
                        worst, where = abs(delta), i
            for u in range(m):
                for i in range(n + 1):
                    s.moment[u, i] += out[i, u]
            ledger.count[1] += 1
            correction = sqrt(square / (n + 1))
            if not correction < 1e12 * method.tolerance:
                break  # diverged, or not a number
            if iteration > 0 and last > 0.0:
                curvature = correction / (last * last)
            confirmed = since < CONFIRM_EVERY or iteration > 0
            if correction < 1e-3 * method.tolerance or (
                confirmed and SAFETY * curvature * correction * correction < method.tolerance
            ):
                converged = True
                since = 0 if iteration > 0 else since + 1
                break
            last = correction

        if not converged:
            s.r[:], s.v[:], s.a[:], s.moment[:] = r0, v0, a0, moment0
            s.clock[0] = t
            if level == method.halvings:
                move(p, s, t)
                ledger.failure[0] = t
                ledger.failure[1] = where
                ledger.failure[2] = worst
                return NOT_CONVERGED
            level, left, h = level + 1, 2 * left, 0.5 * h
            curvature = np.inf
            ledger.count[2] += 1
            continue

        forces(p, s)
        force1[:] = s.force
        inertia(p, s)
        inert1[:] = s.force
        s.flow[:] = 0.0
        every(p.power, s)
        kinetic1 = every(p.kinetic, s)
        # Numerical dissipation: work of the inertial forces by the trapezoidal rule that does not
        # come from kinetic energy.
        numerical = kinetic0 - kinetic1
        for c in range(d):
            for i in range(n + 1):
                follower[c, i] += ((1.0 - af) * s.a[c, i] + af * a0[c, i] - follower[c, i]) / (
                    1.0 - am
                )
                numerical -= 0.5 * (inert0[c, i] + inert1[c, i]) * (s.r[c, i] - r0[c, i])
        held = supplied(s, force1, inert1, fixed)
        held_work = 0.5 * h * (held + held0)
        given = 0.5 * h * (s.flow[1] + flow0[1])
        lost = 0.5 * h * (s.flow[0] + flow0[0])
        ledger.work[0] += held_work
        ledger.work[1] += given
        ledger.work[2] += lost
        ledger.work[3] += numerical
        ledger.work[4] += abs(held_work) + abs(given) + lost
        flow0[:] = s.flow
        kinetic0, held0 = kinetic1, held
        ledger.count[0] += 1

        # outputs between the steps, then at the new step
        while k_out < record.time.shape[0] and record.time[k_out] < t + h * (1.0 - 1e-9):
            x = (record.time[k_out] - t) / h
            interpolate(so, r0, v0, a0, t, s.r, s.v, s.a, t + h, record.time[k_out])
            for u in range(m):
                for i in range(n + 1):
                    so.moment[u, i] = (1.0 - x) * moment0[u, i] + x * s.moment[u, i]
            evaluate_and_note(p, so, record, k_out)
            k_out += 1
        if t + h >= first:
            tabulate(s, record.values)
            widen(record)
        if k_out < record.time.shape[0] and record.time[k_out] <= t + h * (1.0 + 1e-9):
            note(p, s, record, k_out)
            k_out += 1

        left -= 1
        if left == 0:
            step += 1
            if level > 0:
                level, h, curvature = 0, method.step, np.inf
            left = 1
            s.clock[0] = start + step * method.step
    return DONE


@inner
def supplied(s, force, inert, fixed):
    """Power that supports supply through the directions they hold (W)."""
    m = len(s.dof) - len(s.dim)
    power = 0.0
    for f in range(fixed.shape[0]):
        i, c = fixed[f, 0], fixed[f, 1] - m
        if c >= 0:
            power -= (force[c, i] + inert[c, i]) * s.v[c, i]
    return power
