"""Static equilibrium by Newton's iteration with the analytic tangent.

Far from equilibrium, a pseudo-mass damps the iteration. It decreases with the residual, so the last steps are
undamped Newton steps. A current is applied in parts, after tension has straightened the riser.
"""

from __future__ import annotations

from contextlib import suppress
from math import sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.solve.blocktri import solve
from riserstudy.solve.evaluate import forces, move_to, tangent
from riserstudy.solve.jit import kernel
from riserstudy.solve.program import Packed

MOST_ITERATIONS = 200
PARTS = 0.5, 0.25, 0.125  # of corrections, where whole ones alternate without end
PATIENCE = 50  # iterations with a part of each correction, times that part


class NoEquilibrium(Exception):
    """Newton's iteration found no equilibrium."""

    def __init__(self, node: int, residual: float, load: float):
        self.node, self.residual, self.load = node, residual, load
        super().__init__(f"residual {residual:.3g} N at node {node}, {load:.0%} of the current")


class Equilibrium(NamedTuple):
    """Facts about the search for an equilibrium."""

    iterations: int  # of the searches that found it, by parts of the current
    residual: float  # largest unbalanced force before the last correction (N)
    unstable: int  # number of directions with negative stiffness


@kernel
def _newton(p, s, fixed, out, work, pseudo, limit, most):
    """One damped iteration; returns residual force, its node, the correction, and negative pivots.

    ``limit``: largest correction that is applied (m); ``most``: largest share of it.
    The residual is the largest, or the first that is not a number. A correction that is not finite, due to a
    singular tangent, is returned but not applied.
    """
    d = len(s.dim)
    m = len(s.dof) - d
    n = s.r.shape[1] - 1  # the last node, loose ones included
    s.rate[:] = 0.0
    forces(p, s)
    tangent(p, s)
    for i in range(n + 1):
        for u in range(m):
            out[i, u] = s.turn[u, i]
        for c in range(d):
            out[i, m + c] = s.force[c, i]
            s.k_node[i, c * d + c] += pseudo
    for f in range(fixed.shape[0]):
        out[fixed[f, 0], fixed[f, 1]] = 0.0
    residual, node = 0.0, 0
    for i in range(n + 1):
        for c in range(d):
            if residual == residual and not abs(out[i, m + c]) <= residual:
                residual, node = abs(out[i, m + c]), i
    negative = solve(s, out, work, fixed)
    square = 0.0
    for i in range(n + 1):
        for c in range(d):
            square += out[i, m + c] ** 2
    correction = sqrt(square / (n + 1))
    share = min(most, limit / correction) if correction > 0.0 else most
    for i in range(n + 1 if correction < np.inf else 0):
        for u in range(m):
            s.moment[u, i] += share * out[i, u]
        for c in range(d):
            s.r[c, i] += share * out[i, m + c]
    return residual, node, correction, negative


def find_equilibrium(
    programs: Packed, state: Packed, fixed: np.ndarray, tolerance: float, current: bool
) -> Equilibrium:
    """Bring a state to static equilibrium at its present time, from its present shape.

    Parameters
    ----------
    fixed : (k, 2) integers, (node, unknown) pairs that do not change.
    tolerance : correction (root mean square over nodes) at which the iteration ends (m).
    current : whether there is a current, which is applied in parts.

    Raises
    ------
    NoEquilibrium
        With the node and residual of the last attempt.
    """
    s = state.value
    move_to(programs, state, s.clock[0])
    s.platform[1:] = 0.0  # at rest in its present position
    s.carried[1:] = 0.0
    s.v[:] = 0.0
    s.a[:] = 0.0
    reached, part = 0.0, 1.0
    s.clock[1] = 0.0 if current else 1.0  # share of the current
    result = _search(programs, state, fixed, tolerance)
    total = result.iterations
    while current and reached < 1.0:
        before = s.r.copy(), s.moment.copy()
        s.clock[1] = min(1.0, reached + part)
        try:
            result = _search(programs, state, fixed, tolerance)
            reached, part, total = s.clock[1], 2.0 * part, total + result.iterations
        except NoEquilibrium:
            s.r[:], s.moment[:] = before
            part *= 0.5
            if part < 1e-3:
                s.clock[1] = 1.0
                raise
    return result._replace(iterations=total)


def unstable_directions(programs: Packed, state: Packed, fixed: np.ndarray) -> int:
    """Number of unstable directions in the present shape, without a search for equilibrium.

    ``fixed`` as in `find_equilibrium`, (k, 2).
    """
    s = state.value
    move_to(programs, state, s.clock[0])
    shape = s.r.shape[1], len(s.dof)
    out, work = np.zeros(shape), np.zeros((shape[0], shape[1] ** 2))
    return int(_newton(programs, state, fixed, out, work, 0.0, 0.0, 1.0)[3])


def _search(programs, state, fixed, tolerance) -> Equilibrium:
    """Newton's iteration; if it fails or ends at a saddle point, it is repeated with more damping.

    If that fails, too, it is continued with a part of each correction.
    """
    s = state.value
    start = s.r.copy(), s.moment.copy()
    try:
        equilibrium = _iterate(programs, state, fixed, tolerance, cautious=False)
        if not equilibrium.unstable:
            return equilibrium
        bold = equilibrium, s.r.copy(), s.moment.copy()
    except NoEquilibrium:
        bold = None
    s.r[:], s.moment[:] = start
    try:
        return _iterate(programs, state, fixed, tolerance, cautious=True)
    except NoEquilibrium as failure:
        if bold is None:
            return _continue_in_parts(programs, state, fixed, tolerance, start, failure)
        equilibrium, s.r[:], s.moment[:] = bold
        return equilibrium


def _continue_in_parts(programs, state, fixed, tolerance, start, failure) -> Equilibrium:
    """Newton's iteration that applies a part of each correction, for cylinders near their stops.

    Whole corrections can alternate between contact and no contact, and the tangent does not include that
    stops at one side of the tension ring turn it back. The iteration continues from its present shape, which
    is near an equilibrium if corrections alternate, and then from the shape at the start.
    """
    s = state.value
    for _ in range(2):
        for part in PARTS:
            with suppress(NoEquilibrium):
                return _iterate_in_part(programs, state, fixed, tolerance, part)
        s.r[:], s.moment[:] = start
    raise failure


def _iterate_in_part(programs, state, fixed, tolerance, part) -> Equilibrium:
    s = state.value
    n, nb = s.r.shape[1], len(s.dof)
    out, work = np.zeros((n, nb)), np.zeros((n, nb * nb))
    limit = 0.1 * s.l0.sum()
    for iteration in range(int(PATIENCE / part)):
        residual, node, correction, negative = _newton(programs, state, fixed, out, work, 0.0, limit, part)
        if not correction < np.inf:
            break
        if correction < 0.1 * tolerance:  # what the parts leave adds up
            return Equilibrium(iteration + 1, float(residual), int(negative))
    raise NoEquilibrium(int(node), float(residual), float(s.clock[1]))


def _iterate(programs, state, fixed, tolerance, cautious) -> Equilibrium:
    """Newton's iteration, with a pseudo-mass while the residual does not decrease.

    ``cautious``: also while the tangent has unstable directions, towards which Newton's iteration would move.
    """
    s = state.value
    nb = len(s.dof)
    n = s.r.shape[1]
    out, work = np.zeros((n, nb)), np.zeros((n, nb * nb))
    limit = 0.1 * s.l0.sum()
    pseudo, first, before = 0.0, 0.0, np.inf
    for iteration in range(MOST_ITERATIONS):
        residual, node, correction, negative = _newton(programs, state, fixed, out, work, pseudo, limit, 1.0)
        if iteration == 0:
            first = max(residual, 1e-300)
            stiff = np.abs(s.k_segment).max() + np.abs(s.k_node).max()
        if not correction < np.inf:
            if pseudo > 0.0:
                break
            pseudo = 1e-6 * stiff  # a string that is not under tension yet has no lateral stiffness
            continue
        if correction < tolerance and pseudo * correction <= 1e-3 * first:
            if pseudo == 0.0:
                return Equilibrium(iteration + 1, float(residual), int(negative))
            pseudo = 0.0
            continue
        pseudo = 0.0 if residual < 0.3 * before else max(0.5 * pseudo, 1e-6 * stiff)
        if residual > before:
            pseudo *= 4.0
        if cautious and negative > 0:
            pseudo = max(10.0 * pseudo, 1e-6 * stiff)
        before = residual
    raise NoEquilibrium(int(node), float(residual), float(s.clock[1]))
