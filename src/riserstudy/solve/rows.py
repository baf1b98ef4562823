"""One block row of a block tridiagonal system, kept in registers.

A row of size b is a tuple, row by row, of [diagonal | upper | right-hand side], each of its b lines
2 b + 1 long. Written out while compiling: a loop over arrays takes twice the time.
"""

from __future__ import annotations

from riserstudy.solve.vec import _each, _tuple, unrolled


def _lines(size):
    return "(" + "".join(f"r{p}_{q}, " for p in range(size) for q in range(2 * size + 1)) + ")"


def _unpack(size):
    return f"{_lines(size)} = row"


def _eliminate(size):
    text = [_unpack(size)]
    for p in range(size):
        for k in range(size):
            factor = f"low[{p * size + k}]"
            for q in range(size):
                text.append(f"r{p}_{q} -= {factor} * upper[{k * size + q}]")
            text.append(f"r{p}_{2 * size} -= {factor} * right[{k}]")
    return "\n    ".join([*text, f"return {_lines(size)}"])


def _divide(size):
    width = 2 * size + 1
    text = [_unpack(size)]
    for p in range(size):
        text.append(f"inverse = 1.0 / r{p}_{p}")
        text.append(f"pivot{p} = r{p}_{p}")
        text += [f"r{p}_{q} *= inverse" for q in range(p + 1, width)]
        for k in range(size):
            if k != p:
                text += [f"r{k}_{q} -= r{k}_{p} * r{p}_{q}" for q in range(p + 1, width)]
    upper = "".join(f"r{p}_{q}, " for p in range(size) for q in range(size, 2 * size))
    right = "".join(f"r{p}_{2 * size}, " for p in range(size))
    pivots = "".join(f"pivot{p}, " for p in range(size))
    return "\n    ".join([*text, f"return ({upper}), ({right}), ({pivots})"])


@unrolled(_eliminate)
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


@unrolled(_divide)
def divide(like, row):
    """The row divided by its diagonal block: upper, right-hand side, pivots; ``like`` tells the size."""
    size = len(like)
    width = 2 * size + 1
    r = [list(row[p * width : (p + 1) * width]) for p in range(size)]
    pivots = []
    for p in range(size):
        pivots.append(r[p][p])
        r[p] = [x / pivots[-1] for x in r[p]]
        for k in range(size):
            if k != p:
                r[k] = [x - r[k][p] * y for x, y in zip(r[k], r[p], strict=True)]
    upper = tuple(r[p][q] for p in range(size) for q in range(size, 2 * size))
    return upper, tuple(line[-1] for line in r), tuple(pivots)


@unrolled(
    lambda size: (
        "return ("
        + "".join(
            f"right[{p}] - "
            + " - ".join(f"upper[{p * size + q}] * after[{q}]" for q in range(size))
            + ", "
            for p in range(size)
        )
        + ")"
    )
)
def back(right, upper, after):
    """Solution of a divided row, given that of the row after it."""
    size = len(right)
    return tuple(
        right[p] - sum(upper[p * size + q] * after[q] for q in range(size)) for p in range(size)
    )


def _read(shape):
    def body(size):
        lines, columns = shape(size)
        items = "".join(f"array[{p}, {q}], " for p in range(lines) for q in range(columns))
        return f"return ({items})"

    return body


@unrolled(_read(lambda size: (size, 2 * size + 1)))
def whole_row(like, array):
    """An array (size, 2 size + 1) as a row."""
    return tuple(x for row in array for x in row)


@unrolled(_read(lambda size: (size, size)))
def square_block(like, array):
    """An array (size, size) as a block."""
    return tuple(x for row in array for x in row)


@unrolled(_each("array[i, #] = a[#]", "; "))
def put_line(a, array, i):
    """Store a tuple in line i of an array."""
    for k, x in enumerate(a):
        array[i, k] = x


@unrolled(_tuple("array[i, #]"))
def line(like, array, i):
    """Line i of an array."""
    return tuple(array[i, k] for k in range(len(like)))
