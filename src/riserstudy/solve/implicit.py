r"""Generalised-alpha stepping with Newton's iteration and the analytic tangent.

Forces balance at every step, :math:`I(r_{n+1}, \hat a_{n+1}) + F_{n+1} = 0`, with the true acceleration;
Newmark's formulas run on an auxiliary one that follows it (Arnold and Brüls 2007),

.. math::

   (1-\alpha_m)\,a_{n+1} + \alpha_m a_n = (1-\alpha_f)\,\hat a_{n+1} + \alpha_f \hat a_n .

Where mass is constant this is the method of Chung and Hulbert (1993); where it turns with the pipe, as
added mass does, this form stays second order. alpha_m = alpha_f = 0 is Newmark's method.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.jit import kernel
from riserstudy.solve.evaluate import forces, inertia, move
from riserstudy.solve.newton import NODE, SIZE, balance, correct, elapsed, new_memory, supplied
from riserstudy.solve.program import every
from riserstudy.solve.record import between, note, tabulate, widen

DONE, NOT_CONVERGED = 0, 1


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
    start: int  # steps that a graded start replaces by three times as many, 0 for none


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

    out, work = np.zeros((n + 1, nb)), np.zeros((n + 1, nb * nb))
    r0, v0, a0 = np.zeros((d, n + 1)), np.zeros((d, n + 1)), np.zeros((d, n + 1))
    moment0 = np.zeros((m, n + 1))
    force1 = np.zeros((d, n + 1))
    inert0, inert1 = np.zeros((d, n + 1)), np.zeros((d, n + 1))
    flow0 = np.zeros(2)

    memory = new_memory()
    level, left = 0, 1
    h = method.step * (elapsed(1, method.start) - elapsed(0, method.start))
    k_out, step = 0, 0

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

    while step < method.steps + 2 * method.start:
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

        if not correct(p, s, method.tolerance, method.iterations, memory, out, work, fixed, ledger):
            s.r[:], s.v[:], s.a[:], s.moment[:] = r0, v0, a0, moment0
            s.clock[0] = t
            if level == method.halvings:
                move(p, s, t)
                ledger.failure[0] = t
                ledger.failure[1] = memory[NODE]
                ledger.failure[2] = memory[SIZE]
                return NOT_CONVERGED
            level, left, h = level + 1, 2 * left, 0.5 * h
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

        k_out = between(p, s, so, r0, v0, a0, moment0, t, h, record, k_out)
        if t + h >= first:
            tabulate(s, record.values)
            widen(record)
        if k_out < record.time.shape[0] and record.time[k_out] <= t + h * (1.0 + 1e-9):
            note(p, s, record, k_out)
            k_out += 1

        left -= 1
        if left == 0:
            step += 1
            level, left = 0, 1
            done = elapsed(step, method.start)
            h = method.step * (elapsed(step + 1, method.start) - done)
            s.clock[0] = start + done * method.step
    return DONE
