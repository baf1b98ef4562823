r"""Explicit leapfrog (Verlet) stepping with lumped masses.

.. math:: v_{n+1/2} = v_{n-1/2} + h\,M^{-1} F(r_n, v_{n-1/2}),\qquad r_{n+1} = r_n + h\,v_{n+1/2}

Second order, symplectic without damping, stable below :func:`riserstudy.solve.modes.stable_step`. The
state must have mass shares (1/2, 0); the mass matrix is then one block per node.
"""

from __future__ import annotations

from riserstudy.solve.envelopes import widen
from riserstudy.solve.evaluate import load, move, shape, true_moments
from riserstudy.solve.interpolate import interpolate
from riserstudy.solve.jit import inner, kernel
from riserstudy.solve.program import call_all
from riserstudy.solve.state import ACCELERATION, DISSIPATED, SUPPLIED, VELOCITY, clear, copy, new_before
from riserstudy.solve.sums import DONE, EVALUATIONS, NOT_CONVERGED, STOPPED, enter, fail
from riserstudy.solve.vec import at, outer, put, solved
from riserstudy.solve.write_down import due, evaluate_and_note, remember


@inner
def accelerate(p, s, fixed):
    """Acceleration of every node from the forces on it; returns the power of the supports (W).

    Held directions keep their prescribed acceleration.
    """
    shape(p, s)
    true_moments(s)
    load(p, s)
    clear(s.lumps)
    call_all(p.lump, s)
    power = hold(s, fixed)
    square = outer(s.dim, s.dim)
    for i in range(s.r.shape[1]):
        put(s.a, i, solved(at(square, s.lump, i), at(s.dim, s.force, i)))
    return power + couple(s, fixed)


@inner
def hold(s, fixed):
    """Remove held directions from the equations; returns the power of their forces (W).

    Masses that couple them to other directions are stored below the diagonal.
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
    """Power that supports supply (W) through the coupling masses to accelerations of free directions."""
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
def advance(s, h):
    """Advance velocities, then positions; returns the sum of squared velocities at half the step."""
    r, v, a = s.r, s.v, s.a
    square = 0.0
    for c in range(len(s.dim)):
        for i in range(r.shape[1]):
            kick = h * a[c, i]
            now = v[c, i] + 0.5 * kick
            square += now * now
            v[c, i] += kick
            r[c, i] += h * v[c, i]
    return square


@inner
def halfway(s, h, into):
    """Velocities half a time step later."""
    for c in range(len(s.dim)):
        for i in range(s.r.shape[1]):
            into[c, i] = s.v[c, i] + 0.5 * h * s.a[c, i]


@kernel
def leapfrog(p, s, so, h, steps, bound, fixed, record, sums):
    """March ``steps`` steps of ``h`` from the state ``s``; outputs go to ``record``.

    Returns NOT_CONVERGED as soon as the sum of squared velocities is not below ``bound``, and STOPPED if
    ``sums.stop`` is set.
    """
    before, after = new_before(s), new_before(s)
    s.rate[VELOCITY], s.rate[ACCELERATION] = 0.0, 1.0
    start = s.clock[0]
    move(p, s, start)
    power0 = accelerate(p, s, fixed)
    lost0, given0 = flow(p, s)
    halfway(s, -h, s.v)
    for step in range(steps + 1):
        t = start + step * h
        # s.r and s.a are at t; s.v is at t - h/2, except for held directions, whose s.v is at t
        if step == steps and not due(record, t + 1e-9 * h):
            break
        if sums.stop[0] != 0:
            return STOPPED
        written = due(record, t + h * (1.0 - 1e-9))
        if written:
            copy(before.r, s.r)
            copy(before.a, s.a)
            halfway(s, h, before.v)
        if not advance(s, h) < bound:
            halfway(s, -h, before.v)
            return failed(sums, before.v, t, h)
        move(p, s, t + h)
        power1 = accelerate(p, s, fixed)
        lost, given = flow(p, s)
        sums.count[EVALUATIONS] += 1
        if written:
            copy(after.r, s.r)
            copy(after.a, s.a)
            halfway(s, h, after.v)
        while due(record, t + h * (1.0 - 1e-9)):
            time = record.time[record.written[0]]
            interpolate(so, before, t, after, t + h, time)
            copy(so.moment, s.moment)
            record.when[2] = time
            evaluate_and_note(p, so, record)
            widen(record, 0)
            remember(record)
        enter(sums, 0.5 * h * (power0 + power1), 0.5 * h * (given + given0), 0.5 * h * (lost + lost0), 0.0)
        power0, lost0, given0 = power1, lost, given
    s.clock[0] = start + steps * h
    halfway(s, h, s.v)
    call_all(p.place, s)
    return DONE


@inner
def flow(p, s):
    """Power dissipated, and power supplied by water and devices (W)."""
    s.flow[DISSIPATED], s.flow[SUPPLIED] = 0.0, 0.0
    call_all(p.power, s)
    return s.flow[DISSIPATED], s.flow[SUPPLIED]


@inner
def failed(sums, v, t, h):
    """Record the node with the largest growth of velocity relative to ``v``."""
    fastest, node = 0.0, 0
    for c in range(v.shape[0]):
        for i in range(v.shape[1]):
            if not abs(v[c, i]) <= fastest:
                fastest, node = abs(v[c, i]), i
    fail(sums, t, node, h * fastest)
    return NOT_CONVERGED
