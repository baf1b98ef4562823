r"""Generalised-alpha stepping with Newton's iteration and the analytic tangent.

Forces balance at every step, :math:`I(r_{n+1}, \hat a_{n+1}) + F_{n+1} = 0`, with the true acceleration;
Newmark's formulas use an auxiliary acceleration that follows it (Arnold and Brüls 2007),

.. math::

   (1-\alpha_m)\,a_{n+1} + \alpha_m a_n = (1-\alpha_f)\,\hat a_{n+1} + \alpha_f \hat a_n .

For a constant mass, this is the method of Chung and Hulbert (1993). For a mass that rotates with the pipe,
such as added mass, this form remains of second order. alpha_m = alpha_f = 0 is Newmark's method.

Internal variables of effects are integrated by the trapezoidal rule, without an auxiliary rate. Their
equations are of first order, and the effects themselves damp their stiff components.

The first-order motion of a top is prescribed and not integrated: the top is stepped without this motion.
"""

from __future__ import annotations

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
    copy,
    keep,
    know_internal,
    new_before,
    release,
    restore,
)
from riserstudy.solve.sums import DONE, NOT_CONVERGED, STOPPED, enter
from riserstudy.solve.write_down import note_start, note_step


class Method(NamedTuple):
    """Parameters of one run."""

    alpha_m: float  # (1)
    alpha_f: float  # (1)
    beta: float  # (1)
    gamma: float  # (1)
    step: float  # (s)
    steps: int
    tolerance: Tolerance
    iterations: int  # largest number of Newton iterations in a time step
    halvings: int  # largest number of halvings of a time step that fails
    start: int  # time steps that a graded start replaces by three times their number, 0 for none


def generalised_alpha(rho_inf) -> tuple[float, float, float, float]:
    """alpha_m, alpha_f, beta, gamma for a spectral radius at infinite frequency."""
    alpha_m = (2.0 * rho_inf - 1.0) / (rho_inf + 1.0)
    alpha_f = rho_inf / (rho_inf + 1.0)
    gamma = 0.5 - alpha_m + alpha_f
    return alpha_m, alpha_f, 0.25 * (gamma + 0.5) ** 2, gamma


@inner
def _predict(s, before, follower, method, h):
    """Predict the end of a step of length h, with the rates of the tangent and known internal variables."""
    af = method.alpha_f
    s.rate[VELOCITY] = method.gamma / (method.beta * h)
    s.rate[ACCELERATION] = (1.0 - method.alpha_m) / ((1.0 - af) * method.beta * h * h)
    release(s)
    s.internal_share[0] = 0.5 * h
    for k in range(s.internal.shape[0]):
        for i in range(s.internal.shape[1]):
            s.internal_known[k, i] = before.internal[k, i] + 0.5 * h * before.internal_rate[k, i]
    for c in range(s.r.shape[0]):
        for i in range(s.r.shape[1]):
            s.r[c, i] += h * s.v[c, i] + 0.5 * h * h * follower[c, i]
            s.v[c, i] += h * follower[c, i]
            s.a[c, i] = (follower[c, i] - af * s.a[c, i]) / (1.0 - af)


@inner
def _follow(s, before, follower, method, inert0, inert1):
    """The auxiliary acceleration of the next step, and the work of the inertial forces (J).

    The work is by the trapezoidal rule, from the inertial forces before and after the step.
    """
    am, af = method.alpha_m, method.alpha_f
    top, work = s.l0.shape[0], 0.0
    for c in range(s.r.shape[0]):
        for i in range(s.r.shape[1]):
            mean = (1.0 - af) * s.a[c, i] + af * before.a[c, i]
            follower[c, i] += (mean - follower[c, i]) / (1.0 - am)
            work += 0.5 * (inert0[c, i] + inert1[c, i]) * (s.r[c, i] - before.r[c, i])
        # the top without its first-order motion
        follower[c, top] -= ((1.0 - af) * s.carried[2, c] + af * before.carried[2, c]) / (1.0 - am)
        way = s.carried[0, c] - before.carried[0, c]
        work -= 0.5 * (s.carried[3, c] + before.carried[3, c]) * way
    return work


@kernel
def march(p, s, so, method, fixed, record, sums):
    """March from the state ``s`` at time ``s.clock[0]``; outputs go to ``record``.

    ``so`` is a second state of the same model, for evaluations at output times.
    Returns DONE, NOT_CONVERGED (``sums.failure`` then has time and node), or STOPPED if ``sums.stop`` is set.
    """
    d = len(s.dim)
    nb = len(s.dof)
    n = s.r.shape[1] - 1  # the last node, loose ones included
    top = s.l0.shape[0]

    out, work = np.zeros((n + 1, nb)), np.zeros((n + 1, nb * nb))
    before = new_before(s)
    force = np.zeros((d, n + 1))
    inert0, inert1 = np.zeros((d, n + 1)), np.zeros((d, n + 1))

    memory, pace = new_memory(), new_pace(method)
    know_internal(s)
    balance(p, s, out, work, fixed)
    follower = s.a.copy()  # the auxiliary acceleration
    for c in range(d):
        follower[c, top] -= s.carried[2, c]
    held0 = account(p, s, force, fixed)
    copy(inert1, s.force)
    lost0, given0 = s.flow[DISSIPATED], s.flow[SUPPLIED]
    kinetic0 = call_all(p.kinetic, s)
    begin = s.clock[0]
    note_start(p, s, record, begin)

    while under_way(pace, method):
        if sums.stop[0] != 0:
            return STOPPED
        t, h = s.clock[0], pace[LENGTH]
        keep(s, before)
        copy(inert0, inert1)
        _predict(s, before, follower, method, h)
        move(p, s, t + h)

        if not correct(p, s, method.tolerance, method.iterations, memory, out, work, fixed, sums):
            restore(s, before)
            if not halve(p, s, t, pace, method, memory, sums):
                return NOT_CONVERGED
            continue

        held = account(p, s, force, fixed)
        copy(inert1, s.force)
        know_internal(s)
        kinetic1 = call_all(p.kinetic, s)
        # numerical dissipation: the work of the inertial forces that no decrease of kinetic energy explains
        numerical = kinetic0 - kinetic1 - _follow(s, before, follower, method, inert0, inert1)
        lost, given = s.flow[DISSIPATED], s.flow[SUPPLIED]
        half = 0.5 * h
        enter(sums, half * (held + held0), half * (given + given0), half * (lost + lost0), numerical)
        kinetic0, held0, lost0, given0 = kinetic1, held, lost, given
        note_step(p, s, so, before, t, h, record)
        advance(s, pace, method, begin)
    return DONE
