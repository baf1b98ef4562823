"""Linear algebra of one Newton step: a block tridiagonal system, one block row per node.

Unknowns of a node are its moments, then its positions. Moments come first because their pivot, the
flexibility, is never zero, while a riser without tension has no lateral stiffness. There is no pivoting: with
positive stiffness the system is quasi-definite, for which elimination in any order is stable.
"""

from __future__ import annotations

import numpy as np

from riserstudy.solve.jit import inner
from riserstudy.solve.rows import (
    back,
    block_below,
    divide,
    eliminate,
    line,
    node_row,
    put_line,
    put_row,
    row_of,
)
from riserstudy.solve.vec import outer


@inner
def solve(s, out, work, fixed):
    """Newton correction for the residuals ``s.turn`` (angles) and ``out`` (forces) in place.

    Parameters
    ----------
    s : State whose tangent has been computed.
    out : (N, m+d) array, residual on entry, correction on return.
    work : (N, (m+d)^2) scratch.
    fixed : (k, 2) integers, (node, unknown) pairs that do not change; sorted by node.

    Returns
    -------
    Number of negative pivots among positions minus number of negative pivots among moments. For a symmetric
    conservative tangent, this is the number of unstable directions.
    """
    nb = len(s.dof)
    m = nb - len(s.dim)
    n = s.r.shape[1] - 1  # index of the last node, loose nodes included
    arrays = s.k_node, s.k_segment, s.k_up, s.k_low
    bent = s.by_low, s.by_up, s.turn_low, s.turn_up, s.flex, s.flex_up
    held = np.zeros((nb, 3 * nb + 1))
    right = s.dof
    upper = outer(right, right)
    negative = 0
    next_fixed = 0
    for i in range(n + 1):
        row = node_row(s.dim, right, arrays, bent, out, i, i - 1)
        low = block_below(s.dim, right, arrays, bent, i - 1)
        if next_fixed < fixed.shape[0] and fixed[next_fixed, 0] == i:
            put_row(held, row, low)
            while next_fixed < fixed.shape[0] and fixed[next_fixed, 0] == i:
                unknown = fixed[next_fixed, 1]
                for q in range(3 * nb + 1):
                    held[unknown, q] = 0.0
                held[unknown, unknown] = 1.0
                next_fixed += 1
            row, low = row_of(right, held)
        upper, right, pivots = divide(right, eliminate(right, upper, low, row))
        for p in range(nb):
            if pivots[p] < 0.0:
                negative += 1 if p >= m else -1
        put_line(right, out, i)
        put_line(upper, work, i)
    for i in range(n - 1, -1, -1):
        right = back(line(right, out, i), line(upper, work, i), right)
        put_line(right, out, i)
    return negative


@inner
def factor_flexibility(s, hinged):
    """Factorise the flexibility matrix, which never changes, for `flexibility_solve`.

    Elimination begins at both ends and meets in the middle: two independent short chains of operations take
    half the time of one long chain.

    ``hinged`` (n+1,) is true for nodes that carry no moment. There the inverse is 0, as in a model without
    bending, whose flexibility is set to 0.
    """
    flex, flex_up, inverse, factor = s.flex, s.flex_up, s.flex_inverse, s.flex_factor
    n = s.l0.shape[0]
    middle = n // 2
    for k in range(n + 1):
        i = k if k < middle else n + middle - k  # 0 ... middle - 1, then n ... middle
        pivot = flex[i]
        if 0 < i <= middle:
            pivot -= flex_up[i - 1] * factor[i - 1]
        if middle <= i < n:
            pivot -= flex_up[i] * factor[i]
        inverse[i] = 1.0 / pivot if pivot > 0.0 and not hinged[i] else 0.0
        if i < middle:
            factor[i] = flex_up[i] * inverse[i]
        if i > middle:
            factor[i - 1] = flex_up[i - 1] * inverse[i]


@inner
def flexibility_solve(s, angle):
    """Convert turning angles (n+1,) to the moments that cause them, in place; zero at hinges.

    Loose nodes do not bend: an array that includes them keeps its values there.
    """
    inverse, factor = s.flex_inverse, s.flex_factor
    n = s.l0.shape[0]
    middle = n // 2
    below, above = angle[0], angle[n]
    for k in range(1, middle):
        below = angle[k] - factor[k - 1] * below
        angle[k] = below
        above = angle[n - k] - factor[n - k] * above
        angle[n - k] = above
    if 2 * middle < n and middle > 0:  # the upper part has one node more
        above = angle[middle + 1] - factor[middle + 1] * above
        angle[middle + 1] = above
    here = angle[middle] - factor[middle] * above
    if middle > 0:
        here -= factor[middle - 1] * below
    below = above = angle[middle] = here * inverse[middle]
    for k in range(1, middle + 1):
        i, j = middle - k, middle + k
        below = angle[i] * inverse[i] - factor[i] * below
        angle[i] = below
        above = angle[j] * inverse[j] - factor[j - 1] * above
        angle[j] = above
    if 2 * middle < n:
        angle[n] = angle[n] * inverse[n] - factor[n - 1] * above
