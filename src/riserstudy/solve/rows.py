"""One block row of a block tridiagonal system, kept in registers.

A row of size b is a tuple, row by row, of [diagonal | upper | right-hand side], each of its b lines
2 b + 1 long. Written out while compiling: a loop over arrays takes twice the time.
"""

from __future__ import annotations

from riserstudy.solve.unroll import unrolled


@unrolled
def eliminate(right, upper, low, row):
    """The row less ``low`` times the divided row (upper, right) before it."""
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
    """The row divided by its diagonal block: upper, right-hand side, pivots; ``like`` tells the size."""
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
    """Solution of a divided row, given that of the row after it."""
    size = len(right)
    return tuple(
        right[p] - sum(upper[p * size + q] * after[q] for q in range(size)) for p in range(size)
    )


@unrolled
def whole_row(like, array):
    """An array (size, 2 size + 1) as a row."""
    size = len(like)
    return tuple(array[p, q] for p in range(size) for q in range(2 * size + 1))


@unrolled
def square_block(like, array):
    """An array (size, size) as a block."""
    return tuple(array[p, q] for p in range(len(like)) for q in range(len(like)))


@unrolled
def put_line(a, array, i):
    """Store a tuple in line i of an array."""
    for k, x in enumerate(a):
        array[i, k] = x


@unrolled
def line(like, array, i):
    """Line i of an array."""
    return tuple(array[i, k] for k in range(len(like)))
