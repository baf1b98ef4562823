r"""Explicit leapfrog (Verlet) stepping with lumped masses.

.. math:: v_{n+1/2} = v_{n-1/2} + h\,M^{-1} F(r_n, v_{n-1/2}),\qquad r_{n+1} = r_n + h\,v_{n+1/2}

Second order, symplectic without damping, stable below :func:`riserstudy.solve.modes.stable_step`. The
state must have been made with mass shares (1/2, 0), so that mass is a block a node.
"""

from __future__ import annotations

import numpy as np

from riserstudy.jit import inner, kernel
from riserstudy.solve.evaluate import load, move, shape, true_moments
from riserstudy.solve.ledger import DONE, NOT_CONVERGED, enter
from riserstudy.solve.program import every
from riserstudy.solve.record import due, evaluate_and_note, interpolate, widen
from riserstudy.solve.state import copy


@inner
def accelerate(p, s, fixed):
    """Acceleration of every node from the forces on it; returns the power of the supports (W).

    Held directions keep the acceleration they are held to.
    """
    d = len(s.dim)
    m = len(s.dof) - d
    shape(p, s)
    true_moments(s)
    load(p, s)
    s.k_node[:] = 0.0
    every(p.mass, s)
    power = 0.0
    for f in range(fixed.shape[0]):
        i, c = fixed[f, 0], fixed[f, 1] - m
        if c >= 0:
            power += (s.k_node[i, c * d + c] * s.a[c, i] - s.force[c, i]) * s.v[c, i]
            for q in range(d):
                s.k_node[i, c * d + q] = 1.0 if q == c else 0.0
            s.force[c, i] = s.a[c, i]
    for i in range(s.r.shape[1]):  # Gauss elimination in the node
        for q in range(d):
            s.a[q, i] = s.force[q, i]
        for q in range(d):
            for w in range(q + 1, d):
                factor = s.k_node[i, w * d + q] / s.k_node[i, q * d + q]
                for c in range(q + 1, d):
                    s.k_node[i, w * d + c] -= factor * s.k_node[i, q * d + c]
                s.a[w, i] -= factor * s.a[q, i]
        for q in range(d - 1, -1, -1):
            for c in range(q + 1, d):
                s.a[q, i] -= s.k_node[i, q * d + c] * s.a[c, i]
            s.a[q, i] /= s.k_node[i, q * d + q]
    return power


@kernel
def leapfrog(p, s, so, h, steps, bound, fixed, record, ledger):
    """March ``steps`` steps of ``h`` from the state ``s``; outputs go to ``record``.

    Returns NOT_CONVERGED as soon as the sum of squared velocities is not below ``bound``.
    """
    d = len(s.dim)
    n = s.r.shape[1] - 1  # the last node, loose ones included
    r0, v0, a0 = np.zeros((d, n + 1)), np.zeros((d, n + 1)), np.zeros((d, n + 1))
    v1 = np.zeros((d, n + 1))
    s.rate[0], s.rate[1] = 0.0, 1.0
    start = s.clock[0]
    move(p, s, start)
    copy(v1, s.v)
    power0 = accelerate(p, s, fixed)
    half = s.v.copy()
    for c in range(d):
        for i in range(n + 1):
            half[c, i] -= 0.5 * h * s.a[c, i]
    s.flow[:] = 0.0
    every(p.power, s)
    lost0, given0 = s.flow[0], s.flow[1]
    for step in range(steps + 1):
        t = start + step * h
        # here s.r is at t, half at t - h/2, s.a at t
        square = 0.0
        for c in range(d):
            for i in range(n + 1):
                v0[c, i] = half[c, i] + 0.5 * h * s.a[c, i]
                square += v0[c, i] * v0[c, i]
        if not square < bound:
            fastest = 0.0
            for c in range(d):
                for i in range(n + 1):
                    if not abs(v0[c, i]) <= fastest:
                        fastest = abs(v0[c, i])
                        ledger.failure[1] = i
            ledger.failure[0], ledger.failure[2] = t, h * fastest
            return NOT_CONVERGED
        if step == steps and not due(record, t + 1e-9 * h):
            break
        copy(r0, s.r)
        copy(a0, s.a)
        for c in range(d):
            for i in range(n + 1):
                half[c, i] += h * a0[c, i]
                s.r[c, i] += h * half[c, i]
                s.v[c, i] = half[c, i]
        move(p, s, t + h)
        power1 = accelerate(p, s, fixed)
        s.flow[:] = 0.0
        every(p.power, s)
        for c in range(d):
            for i in range(n + 1):
                v1[c, i] = half[c, i] + 0.5 * h * s.a[c, i]
        ledger.count[3] += 1
        while due(record, t + h * (1.0 - 1e-9)):
            time = record.time[record.written[0]]
            interpolate(so, r0, v0, a0, t, s.r, v1, s.a, t + h, time)
            copy(so.moment, s.moment)
            evaluate_and_note(p, so, record)
            widen(record)
        lost, given = s.flow[0], s.flow[1]
        enter(
            ledger,
            0.5 * h * (power0 + power1),
            0.5 * h * (given + given0),
            0.5 * h * (lost + lost0),
            0.0,
        )
        power0, lost0, given0 = power1, lost, given
    s.clock[0] = start + steps * h
    copy(s.v, v1)
    return DONE
