r"""Generalised-alpha stepping with Newton's iteration and the analytic tangent.

.. math::

   (1-\alpha_m)\,I_{n+1} + \alpha_m I_n + (1-\alpha_f)\,F_{n+1} + \alpha_f F_n = 0

with the inertial forces I and all other forces F; displacement and velocity follow from acceleration by
Newmark's formulas (Chung and Hulbert 1993). alpha_m = alpha_f = 0 is Newmark's method.

Two measured choices. A practical step needs one correction: the next would be about C d^2, with d the
correction just made and C from the last step that made two, so a second is made only where that
estimate calls for it (half the run time of always confirming). And the acceleration variable of the
method lags the true one by (alpha_f - alpha_m) steps; what is reported and balanced is shifted back, so
support forces stay second order.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.jit import kernel
from riserstudy.solve.blocktri import solve
from riserstudy.solve.evaluate import forces, inertia, move, tangent
from riserstudy.solve.program import every
from riserstudy.solve.record import evaluate_and_note, interpolate, note, tabulate, widen

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
    lag = am - af  # the method's acceleration belongs to the time t + lag * step
    mu = (1.0 - am) / (1.0 - af)

    out, work = np.zeros((n + 1, nb)), np.zeros((n + 1, nb * nb))
    r0, v0, a0 = np.zeros((d, n + 1)), np.zeros((d, n + 1)), np.zeros((d, n + 1))
    moment0 = np.zeros((m, n + 1))
    true0, true1 = np.zeros((d, n + 1)), s.a.copy()  # balanced accelerations
    force0, force1 = np.zeros((d, n + 1)), np.zeros((d, n + 1))
    inert0, inert1 = np.zeros((d, n + 1)), np.zeros((d, n + 1))
    past = np.zeros((d, n + 1))
    flow0 = np.zeros(2)
    reaction0, inert_held = np.zeros(fixed.shape[0]), np.zeros(fixed.shape[0])

    curvature = np.inf  # C of the header
    level, left, since = 0, 1, 0
    h = method.step
    k_out = 0
    step = 0

    forces(p, s)
    force1[:] = s.force
    inertia(p, s)
    inert1[:] = s.force
    s.flow[:] = 0.0
    every(p.power, s)
    flow0[:] = s.flow
    kinetic0 = every(p.kinetic, s)
    for f in range(fixed.shape[0]):
        i, c = fixed[f, 0], fixed[f, 1] - m
        if c >= 0:
            reaction0[f] = -(force1[c, i] + inert1[c, i]) * s.v[c, i]
            inert_held[f] = inert1[c, i]
    start = t = s.clock[0]
    ends0 = s.ends[1].copy()
    first = record.time[0] - 1e-9 * h  # envelopes start with the outputs
    if first <= t:
        tabulate(s, record.values)
        widen(record)
        note(p, s, record, 0)
        k_out = 1

    while step < method.steps:
        t = s.clock[0]
        r0[:], v0[:], a0[:], moment0[:] = s.r, s.v, s.a, s.moment
        true0[:] = true1
        force0[:], inert0[:] = force1, inert1
        s.rate[0], s.rate[1] = gamma / (beta * h), mu / (beta * h * h)
        for c in range(d):
            for i in range(n + 1):
                s.r[c, i] += h * v0[c, i] + 0.5 * h * h * a0[c, i]
                s.v[c, i] += h * a0[c, i]
                past[c, i] = (af * force0[c, i] + am * inert0[c, i]) / (1.0 - af)
        move(p, s, t + h)
        for f in range(fixed.shape[0]):
            i, c = fixed[f, 0], fixed[f, 1] - m
            if c >= 0:  # the method's acceleration lags at held nodes as it does elsewhere
                true1[c, i] = s.a[c, i]
                s.a[c, i] += lag * (s.a[c, i] - true0[c, i])

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
                    out[i, m + c] = force1[c, i] + mu * s.force[c, i] + past[c, i]
            tangent(p, s)
            solve(s, out, work, fixed)
            square, worst = 0.0, 0.0
            for c in range(d):
                for i in range(n + 1):
                    delta = out[i, m + c]
                    s.r[c, i] += delta
                    s.v[c, i] += s.rate[0] * delta
                    s.a[c, i] += delta / (beta * h * h)
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
            true1[:] = true0
            force1[:], inert1[:] = force0, inert0
            s.clock[0] = t
            if level == method.halvings:
                move(p, s, t)
                s.a[:] = a0
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
        for c in range(d):
            for i in range(n + 1):
                true1[c, i] = s.a[c, i] - lag * (s.a[c, i] - a0[c, i])
        s.flow[:] = 0.0
        every(p.power, s)
        kinetic1 = every(p.kinetic, s)
        # Numerical dissipation: what averaging the forces between the steps takes out beyond the
        # trapezoidal rule. Held nodes are not averaged; they take part with their balanced inertia.
        numerical = kinetic0 - kinetic1
        for c in range(d):
            for i in range(n + 1):
                mean = (1.0 - am) * inert1[c, i] + am * inert0[c, i]
                beyond = (af - 0.5) * (force1[c, i] - force0[c, i]) - mean
                numerical += (s.r[c, i] - r0[c, i]) * beyond
        held_work = 0.0
        for f in range(fixed.shape[0]):
            i, c = fixed[f, 0], fixed[f, 1] - m
            if c >= 0:
                balanced = inert1[c, i] - lag * (inert1[c, i] - inert0[c, i])
                power = -(force1[c, i] + balanced) * s.v[c, i]
                held_work += 0.5 * h * (power + reaction0[f])
                mean = (1.0 - am) * inert1[c, i] + am * inert0[c, i]
                beyond = (af - 0.5) * (force1[c, i] - force0[c, i]) - mean
                beyond += 0.5 * (balanced + inert_held[f])
                numerical -= (s.r[c, i] - r0[c, i]) * beyond
                reaction0[f], inert_held[f] = power, balanced
        given = 0.5 * h * (s.flow[1] + flow0[1])
        lost = 0.5 * h * (s.flow[0] + flow0[0])
        ledger.work[0] += held_work
        ledger.work[1] += given
        ledger.work[2] += lost
        ledger.work[3] += numerical
        ledger.work[4] += abs(held_work) + abs(given) + lost
        flow0[:] = s.flow
        kinetic0 = kinetic1
        ledger.count[0] += 1

        # outputs between the steps, then at the new step
        while k_out < record.time.shape[0] and record.time[k_out] < t + h * (1.0 - 1e-9):
            x = (record.time[k_out] - t) / h
            interpolate(so, r0, v0, true0, t, s.r, s.v, true1, t + h, record.time[k_out])
            for u in range(m):
                for i in range(n + 1):
                    so.moment[u, i] = (1.0 - x) * moment0[u, i] + x * s.moment[u, i]
            evaluate_and_note(p, so, record, k_out)
            k_out += 1
        for e in range(2):
            for c in range(d):
                lagging = s.ends[1, e, c]
                s.ends[1, e, c] -= lag * (lagging - ends0[e, c])
                ends0[e, c] = lagging
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
