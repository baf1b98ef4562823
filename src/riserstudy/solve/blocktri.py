"""Linear algebra of one Newton step: a block tridiagonal system, one block row a node.

Unknowns of a node are its moments, then its positions. Moments come first because their pivot, the
flexibility, is never zero, while a slack riser has no lateral stiffness of its own. No pivoting: with
positive stiffness the system is quasi-definite, for which elimination in any order is stable.
"""

from __future__ import annotations

import numpy as np

from riserstudy.jit import inner, kernel


@inner
def solve(s, out, work, fixed):
    """Newton correction for the residuals ``s.turn`` (angles) and ``out`` (forces) in place.

    Parameters
    ----------
    s : State with its tangent filled in.
    out : (n+1, m+d) array, residual on entry, correction on return.
    work : (n+1, m+d, m+d) scratch.
    fixed : (k, 2) integers, (node, unknown) pairs that stay as they are; sorted by node.

    Returns
    -------
    Number of negative pivots among positions less that among moments: for a symmetric conservative
    tangent the number of unstable directions.
    """
    d = len(s.dim)
    nb = len(s.dof)
    m = nb - d
    n = s.l0.shape[0]
    k_node, k_segment, k_up, k_low = s.k_node, s.k_segment, s.k_up, s.k_low
    by_low, by_up, swing, flex, flex_up = s.by_low, s.by_up, s.swing, s.flex, s.flex_up
    here = np.empty((nb, 2 * nb + 1))  # diagonal block, upper block, residual
    low = np.empty((nb, nb))
    negative = 0
    next_fixed = 0
    for i in range(n + 1):
        for p in range(d):
            for q in range(d):
                c = p * d + q
                stiff = k_node[i, c]
                if i > 0:
                    stiff += k_segment[i - 1, c]
                    low[m + p, m + q] = k_low[i - 1, c] - k_segment[i - 1, c]
                if i < n:
                    stiff += k_segment[i, c]
                    here[m + p, nb + m + q] = k_up[i, c] - k_segment[i, c]
                here[m + p, m + q] = stiff
            here[m + p, 2 * nb] = out[i, m + p]
        for u in range(m):
            for p in range(d):
                c = p * m + u
                arm, angle = 0.0, 0.0
                if i > 0:
                    arm += by_up[i - 1, c]
                    angle += swing[i - 1, c]
                    low[m + p, u] = by_low[i - 1, c]
                    low[u, m + p] = -swing[i - 1, c]
                if i < n:
                    arm -= by_low[i, c]
                    angle += swing[i, c]
                    here[m + p, nb + u] = -by_up[i, c]
                    here[u, nb + m + p] = -swing[i, c]
                here[m + p, u] = arm
                here[u, m + p] = angle
            for w in range(m):
                same = 1.0 if u == w else 0.0
                here[u, w] = flex[i] * same
                if i > 0:
                    low[u, w] = flex_up[i - 1] * same
                if i < n:
                    here[u, nb + w] = flex_up[i] * same
            here[u, 2 * nb] = out[i, u]

        while next_fixed < fixed.shape[0] and fixed[next_fixed, 0] == i:
            row = fixed[next_fixed, 1]
            for q in range(2 * nb + 1):
                here[row, q] = 0.0
            for q in range(nb):
                low[row, q] = 0.0
            here[row, row] = 1.0
            next_fixed += 1

        if i > 0:  # eliminate the node below
            for p in range(nb):
                for k in range(nb):
                    factor = low[p, k]
                    for q in range(nb):
                        here[p, q] -= factor * work[i - 1, k, q]
                    here[p, 2 * nb] -= factor * out[i - 1, k]
        for p in range(nb):  # Gauss-Jordan within the node
            pivot = here[p, p]
            if pivot < 0.0:
                negative += 1 if p >= m else -1
            inverse = 1.0 / pivot
            for q in range(p + 1, 2 * nb + 1):
                here[p, q] *= inverse
            for k in range(nb):
                if k != p:
                    factor = here[k, p]
                    for q in range(p + 1, 2 * nb + 1):
                        here[k, q] -= factor * here[p, q]
        for p in range(nb):
            out[i, p] = here[p, 2 * nb]
            for q in range(nb):
                work[i, p, q] = here[p, nb + q]
    for i in range(n - 1, -1, -1):
        for p in range(nb):
            for q in range(nb):
                out[i, p] -= work[i, p, q] * out[i + 1, q]
    return negative


@inner
def flexibility_solve(flex, flex_up, hinged, angle, scratch):
    """Turning angles (n+1,) into the moments that belong to them, in place.

    ``hinged`` (n+1,) is true where no moment is carried.
    """
    n = flex_up.shape[0]
    below = 0.0  # flexibility coupling to the node below, 0 across a hinge
    for i in range(n + 1):
        if hinged[i]:
            angle[i], scratch[i], below = 0.0, 0.0, 0.0
            continue
        pivot = flex[i]
        if below != 0.0:
            pivot -= below * scratch[i - 1]
            angle[i] -= below * angle[i - 1]
        below = flex_up[i] if i < n and not hinged[i + 1] else 0.0
        scratch[i] = below / pivot
        angle[i] /= pivot
    for i in range(n - 1, -1, -1):
        angle[i] -= scratch[i] * angle[i + 1]


@kernel
def solve_once(s, out, work, fixed):
    """`solve` for callers in Python."""
    return solve(s, out, work, fixed)
