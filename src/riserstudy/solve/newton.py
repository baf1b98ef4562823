r"""Newton's iteration of one implicit step or stage, at whose end the forces balance.

A typical step needs one correction. The next correction would be about C d^2, with the last correction d, and
C from the last step with two corrections. A second correction is made only if this estimate exceeds the
tolerance, which takes half the time of always confirming. Even a position error far below a segment's length
can be a large moment error in a short segment. The estimate must therefore also be small for moments, which
change in the same proportion.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.solve.blocktri import solve
from riserstudy.solve.evaluate import forces, inertia, tangent
from riserstudy.solve.jit import inner
from riserstudy.solve.program import call_all
from riserstudy.solve.state import ACCELERATION, VELOCITY, clear_tangent, copy
from riserstudy.solve.sums import ITERATIONS

CONFIRM_EVERY = 32  # steps after which C is measured again
SAFETY = 4.0  # factor on the estimate C d^2
CURVATURE, SINCE, NODE, SIZE = 0, 1, 2, 3  # entries of the memory


class Tolerance(NamedTuple):
    """Limits of the predicted next correction, at which the iteration ends."""

    position: float  # root mean square over nodes (m)
    moment: float  # largest change of a moment, as a share of the largest moment (1)


@inner
def new_memory():
    """Memory with C, steps since it was measured, node and size of the last correction."""
    memory = np.zeros(4)
    memory[CURVATURE] = np.inf
    return memory


@inner
def imbalance(p, s, out):
    """Residuals at each node: turning angles of the moments' equations, and forces with inertia."""
    d = len(s.dim)
    m = len(s.dof) - d
    forces(p, s)
    for i in range(s.r.shape[1]):
        for u in range(m):
            out[i, u] = s.turn[u, i]
        for c in range(d):
            out[i, m + c] = s.force[c, i]
    inertia(p, s)
    for i in range(s.r.shape[1]):
        for c in range(d):
            out[i, m + c] += s.force[c, i]


@inner
def correct(p, s, tolerance, iterations, memory, out, work, fixed, sums):
    """Correct positions until forces balance; velocity and acceleration follow at the rates ``s.rate``.

    Returns whether it converged; the memory then has the size and the node of the last correction.
    """
    d = len(s.dim)
    m = len(s.dof) - d
    n = s.r.shape[1] - 1  # the last node, loose ones included
    last = 0.0
    for iteration in range(iterations):
        imbalance(p, s, out)
        tangent(p, s)
        solve(s, out, work, fixed)
        square, worst, where = 0.0, 0.0, 0
        for c in range(d):
            for i in range(n + 1):
                delta = out[i, m + c]
                s.r[c, i] += delta
                s.v[c, i] += s.rate[VELOCITY] * delta
                s.a[c, i] += s.rate[ACCELERATION] * delta
                square += delta * delta
                if not abs(delta) <= worst:
                    worst, where = abs(delta), i
        # largest square of a moment's correction, and largest square of a moment
        bent, most = 0.0, 0.0
        for i in range(n + 1):
            change, size = 0.0, 0.0
            for u in range(m):
                s.moment[u, i] += out[i, u]
                change += out[i, u] * out[i, u]
                size += s.moment[u, i] * s.moment[u, i]
            bent, most = max(bent, change), max(most, size)
        sums.count[ITERATIONS] += 1
        memory[NODE], memory[SIZE] = where, worst
        correction = sqrt(square / (n + 1))
        if not correction < 1e12 * tolerance.position:
            break  # diverged, or not a number
        if iteration > 0 and last > 0.0:
            memory[CURVATURE] = correction / (last * last)
        confirmed = memory[SINCE] < CONFIRM_EVERY or iteration > 0
        next_one = SAFETY * memory[CURVATURE] * correction * correction
        settled = (
            next_one < tolerance.position
            and next_one * sqrt(bent) <= tolerance.moment * sqrt(most) * correction
        )
        if correction < 1e-3 * tolerance.position or (confirmed and settled):
            memory[SINCE] = 0.0 if iteration > 0 else memory[SINCE] + 1.0
            return True
        last = correction
    memory[CURVATURE] = np.inf
    return False


@inner
def balance(p, s, out, work, fixed):
    """Accelerations of the free directions from the present forces."""
    d = len(s.dim)
    m = len(s.dof) - d
    n = s.r.shape[1] - 1  # the last node, loose ones included
    imbalance(p, s, out)
    out[:, :m] = 0.0  # moments do not change
    for f in range(fixed.shape[0]):
        out[fixed[f, 0], fixed[f, 1]] = 0.0
    clear_tangent(s)
    s.rate[VELOCITY], s.rate[ACCELERATION] = 0.0, 1.0
    call_all(p.mass, s)
    for i in range(n + 1):
        for c in range(d):
            if s.k_node[i, c * d + c] == 0.0:  # no mass: does not change
                s.k_node[i, c * d + c] = 1.0
                out[i, m + c] = 0.0
    solve(s, out, work, fixed)
    for c in range(d):
        for i in range(n + 1):
            s.a[c, i] += out[i, m + c]


@inner
def account(p, s, force, fixed):
    """Write forces to ``force``, inertia to ``s.force``, and powers of effects to ``s.flow``.

    Returns the power that supports supply through the directions they hold (W).
    """
    m = len(s.dof) - len(s.dim)
    forces(p, s)
    copy(force, s.force)
    inertia(p, s)
    s.flow[:] = 0.0
    call_all(p.power, s)
    power = 0.0
    for f in range(fixed.shape[0]):
        i, c = fixed[f, 0], fixed[f, 1] - m
        if c >= 0:
            power -= (force[c, i] + s.force[c, i]) * s.v[c, i]
    return power
