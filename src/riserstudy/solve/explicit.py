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
from riserstudy.solve.vec import at, outer, put, solved


@inner
def accelerate(p, s, fixed):
    """Acceleration of every node from the forces on it; returns the power of the supports (W).

    Held directions keep the acceleration they are held to.
    """
    shape(p, s)
    true_moments(s)
    load(p, s)
    s.lump[:] = 0.0
    every(p.lump, s)
    power = hold(s, fixed)
    square = outer(s.dim, s.dim)
    for i in range(s.r.shape[1]):
        put(s.a, i, solved(at(square, s.lump, i), at(s.dim, s.force, i)))
    return power + couple(s, fixed)


@inner
def hold(s, fixed):
    """Take held directions out of what is left to solve for; returns the power of their own forces (W).

    Masses that couple them to others go below the diagonal.
    """
    d = len(s.dim)
    m = len(s.dof) - d
    lump, force, a = s.lump, s.force, s.a
    power = 0.0
    for f in range(fixed.shape[0]):
        i, c = fixed[f, 0], fixed[f, 1] - m
        if c >= 0:
            power += (lump[c * d + c, i] * a[c, i] - force[c, i]) * s.v[c, i]
    for f in range(fixed.shape[0]):
        i, c = fixed[f, 0], fixed[f, 1] - m
        if c >= 0:
            for q in range(d):
                if q != c:
                    above, below = min(c, q) * d + max(c, q), max(c, q) * d + min(c, q)
                    force[q, i] -= lump[above, i] * a[c, i]
                    lump[below, i] += lump[above, i]
                    lump[above, i] = 0.0
            lump[c * d + c, i] = 1.0
            force[c, i] = a[c, i]
    return power


@inner
def couple(s, fixed):
    """Power that supports supply (W) to the accelerations of other directions than those they hold."""
    d = len(s.dim)
    m = len(s.dof) - d
    power = 0.0
    for f in range(fixed.shape[0]):
        i, c = fixed[f, 0], fixed[f, 1] - m
        if c >= 0:
            for q in range(d):
                if q != c:
                    power += s.lump[max(c, q) * d + min(c, q), i] * s.a[q, i] * s.v[c, i]
    return power


@inner
def advance(s, half, h):
    """One step of velocities ``half`` and positions; the sum of squared velocities between the two."""
    square = 0.0
    for c in range(len(s.dim)):
        for i in range(s.r.shape[1]):
            kick = h * s.a[c, i]
            now = half[c, i] + 0.5 * kick
            square += now * now
            half[c, i] += kick
            s.r[c, i] += h * half[c, i]
            s.v[c, i] = half[c, i]
    return square


@inner
def drift(s, half, h, v):
    """Velocities in the middle between those before and after, into ``v``."""
    for c in range(len(s.dim)):
        for i in range(s.r.shape[1]):
            v[c, i] = half[c, i] + 0.5 * h * s.a[c, i]


@kernel
def leapfrog(p, s, so, h, steps, bound, fixed, record, ledger):
    """March ``steps`` steps of ``h`` from the state ``s``; outputs go to ``record``.

    Returns NOT_CONVERGED as soon as the sum of squared velocities is not below ``bound``.
    """
    d = len(s.dim)
    n = s.r.shape[1] - 1  # the last node, loose ones included
    r0, v0, a0 = np.zeros((d, n + 1)), np.zeros((d, n + 1)), np.zeros((d, n + 1))
    v1, half = np.zeros((d, n + 1)), np.zeros((d, n + 1))
    s.rate[0], s.rate[1] = 0.0, 1.0
    start = s.clock[0]
    move(p, s, start)
    power0 = accelerate(p, s, fixed)
    copy(half, s.v)
    drift(s, half, -h, half)
    s.flow[:] = 0.0
    every(p.power, s)
    lost0, given0 = s.flow[0], s.flow[1]
    for step in range(steps + 1):
        t = start + step * h
        # here s.r is at t, half at t - h/2, s.a at t
        if step == steps and not due(record, t + 1e-9 * h):
            break
        told = due(record, t + h * (1.0 - 1e-9))
        if told:
            copy(r0, s.r)
            copy(a0, s.a)
            drift(s, half, h, v0)
        if not advance(s, half, h) < bound:
            drift(s, half, -h, v0)
            return failed(ledger, v0, t, h)
        move(p, s, t + h)
        power1 = accelerate(p, s, fixed)
        s.flow[:] = 0.0
        every(p.power, s)
        ledger.count[3] += 1
        if told:
            drift(s, half, h, v1)
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
    drift(s, half, h, s.v)
    return DONE


@inner
def failed(ledger, v, t, h):
    """Say where velocities ``v`` grew most."""
    fastest = 0.0
    for c in range(v.shape[0]):
        for i in range(v.shape[1]):
            if not abs(v[c, i]) <= fastest:
                fastest = abs(v[c, i])
                ledger.failure[1] = i
    ledger.failure[0], ledger.failure[2] = t, h * fastest
    return NOT_CONVERGED
