"""One block row of a block tridiagonal system, in registers.

A row of size b is a tuple, row by row, of [diagonal | upper | right-hand side], each of its b lines
2 b + 1 long. The operations are unrolled while compiling: a loop over arrays takes twice the time.
"""

from __future__ import annotations

from riserstudy.solve.unroll import unrolled


@unrolled
def node_row(dim, dof, stiffness, bent, out, i, e):
    """Equations of node i, angles of the moments before forces, with segment ``e`` below and ``i`` above."""
    d, size = len(dim), len(dof)
    m = size - d
    k_node, k_segment, k_up, _ = stiffness
    by_low, by_up, turn_low, turn_up, flex, flex_up = bent
    row = []
    for u in range(m):
        own = [turn_low[i, p * m + u] for p in range(d)]
        row += [flex[i] if w == u else 0.0 for w in range(m)]
        row += [own[p] - turn_up[e, p * m + u] for p in range(d)]
        row += [flex_up[i] if w == u else 0.0 for w in range(m)]
        row += [-own[p] for p in range(d)]
        row.append(out[i, u])
    for p in range(d):
        above = [k_segment[i, p * d + q] for q in range(d)]
        row += [by_up[e, p * m + u] - by_low[i, p * m + u] for u in range(m)]
        row += [k_node[i, p * d + q] + k_segment[e, p * d + q] + above[q] for q in range(d)]
        row += [-by_up[i, p * m + u] for u in range(m)]
        row += [k_up[i, p * d + q] - above[q] for q in range(d)]
        row.append(out[i, m + p])
    return tuple(row)


@unrolled
def block_below(dim, dof, stiffness, bent, e):
    """Block that couples the node above segment ``e`` to the node below it."""
    d = len(dim)
    m = len(dof) - d
    _, k_segment, _, k_low = stiffness
    by_low, _, _, turn_up, _, flex_up = bent
    low = []
    for u in range(m):
        low += [flex_up[e] if w == u else 0.0 for w in range(m)]
        low += [turn_up[e, p * m + u] for p in range(d)]
    for p in range(d):
        low += [by_low[e, p * m + u] for u in range(m)]
        low += [k_low[e, p * d + q] - k_segment[e, p * d + q] for q in range(d)]
    return tuple(low)


@unrolled
def eliminate(right, upper, low, row):
    """The row minus ``low`` times the previous divided row (upper, right)."""
    size = len(right)
    width = 2 * size + 1
    less = list(row)
    for p in range(size):
        for k in range(size):
            for q in range(size):
                less[p * width + q] -= low[p * size + k] * upper[k * size + q]
            less[p * width + 2 * size] -= low[p * size + k] * right[k]
    return tuple(less)


@unrolled
def divide(like, row):
    """The row divided by its diagonal block: upper, right-hand side, pivots; ``like`` gives the size."""
    size = len(like)
    width = 2 * size + 1
    r = [list(row[p * width : (p + 1) * width]) for p in range(size)]
    pivots = []
    for p in range(size):
        pivots.append(r[p][p])
        inverse = 1.0 / pivots[p]
        for q in range(p + 1, width):
            r[p][q] *= inverse
            for k in range(size):
                if k != p:
                    r[k][q] -= r[k][p] * r[p][q]
    upper = tuple(r[p][q] for p in range(size) for q in range(size, 2 * size))
    return upper, tuple(line[-1] for line in r), tuple(pivots)


@unrolled
def back(right, upper, after):
    """Solution of a divided row, given the solution of the next row."""
    size = len(right)
    return tuple(right[p] - sum(upper[p * size + q] * after[q] for q in range(size)) for p in range(size))


@unrolled
def put_row(array, row, low):
    """Store a row and its lower block in an array (size, 3 size + 1)."""
    size = int(len(low) ** 0.5)
    for p in range(size):
        for q in range(2 * size + 1):
            array[p, q] = row[p * (2 * size + 1) + q]
        for q in range(size):
            array[p, 2 * size + 1 + q] = low[p * size + q]


@unrolled
def row_of(like, array):
    """The row and the lower block that ``put_row`` stored."""
    size = len(like)
    width = 2 * size + 1
    row = tuple(array[p, q] for p in range(size) for q in range(width))
    return row, tuple(array[p, width + q] for p in range(size) for q in range(size))


@unrolled
def put_line(a, array, i):
    """Store a tuple in line i of an array."""
    for k, x in enumerate(a):
        array[i, k] = x


@unrolled
def line(like, array, i):
    """Line i of an array."""
    return tuple(array[i, k] for k in range(len(like)))
