"""Small vectors and square blocks as tuples of floats, unrolled by their length while compiling.

A vector has as many numbers as the model has directions (1, 2 or 3), a block their square, row by
row. The same code of an effect therefore serves axial, planar and spatial models at no cost in run time.
"""

from __future__ import annotations

from riserstudy.solve.unroll import root, unrolled


@unrolled
def add(a, b):
    """Sum of two vectors or two blocks."""
    return tuple(x + y for x, y in zip(a, b, strict=True))


@unrolled
def sub(a, b):
    """Difference of two vectors or two blocks."""
    return tuple(x - y for x, y in zip(a, b, strict=True))


@unrolled
def mul(factor, a):
    """Vector or block times a number."""
    return tuple(factor * x for x in a)


@unrolled
def dot(a, b):
    """Scalar product."""
    return sum(x * y for x, y in zip(a, b, strict=True))


@unrolled
def outer(a, b):
    """Block a bᵀ."""
    return tuple(x * y for x in a for y in b)


@unrolled
def unity(a):
    """Unit block for vectors like ``a``."""
    return tuple(float(i == j) for i in range(len(a)) for j in range(len(a)))


@unrolled
def upward(a):
    """Unit vector up, the last direction, for vectors like ``a``."""
    return (0.0,) * (len(a) - 1) + (1.0,)


@unrolled
def at(like, array, i):
    """Vector i of a component-major array (directions, nodes); ``like`` gives the number of directions."""
    return tuple(array[k, i] for k in range(len(like)))


@unrolled
def bending_at(like, moment, i):
    """Bending moment i, (m, nodes): one number in the plane, three in space."""
    return tuple(moment[k, i] for k in range({2: 1, 3: 3}[len(like)]))


@unrolled
def within(like, array, i):
    """Row i of an array of vectors in space, (rows, 3), in the directions of the model."""
    return tuple(array[i, k] for k in {1: (2,), 2: (0, 2), 3: (0, 1, 2)}[len(like)])


@unrolled
def put(array, i, a):
    """Store a vector in a component-major array."""
    for k, x in enumerate(a):
        array[k, i] = x


@unrolled
def plus(array, i, a):
    """Add a vector to a component-major array."""
    for k, x in enumerate(a):
        array[k, i] += x


@unrolled
def put_block(array, i, a):
    """Store a block in row i of an array (rows, directions squared)."""
    for k, x in enumerate(a):
        array[i, k] = x


@unrolled
def plus_block(array, i, a):
    """Add a block to row i of an array (rows, directions squared)."""
    for k, x in enumerate(a):
        array[i, k] += x


@unrolled
def solved(block, a):
    """The vector x with block x = a, for a symmetric block of which only the upper triangle is read."""
    if len(a) == 1:
        return (a[0] / block[0],)
    if len(a) == 2:
        xx, xy, _, yy = block
        share = 1.0 / (xx * yy - xy * xy)
        return share * (yy * a[0] - xy * a[1]), share * (xx * a[1] - xy * a[0])
    xx, xy, xz, _, yy, yz, _, _, zz = block
    first = yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy
    share = 1.0 / dot((xx, xy, xz), first)
    second = first[1], xx * zz - xz * xz, xy * xz - xx * yz
    third = first[2], second[2], xx * yy - xy * xy
    return tuple(share * dot(row, a) for row in (first, second, third))


@unrolled
def plus_upper(array, i, a):
    """Add the upper triangle of a block to a component-major array (directions squared, nodes)."""
    d = {1: 1, 4: 2, 9: 3}[len(a)]
    for p in range(d):
        for k in range(p * d + p, p * d + d):
            array[k, i] += a[k]


@unrolled
def norm(a):
    """Length of a vector."""
    return root(dot(a, a))


@unrolled
def norm_across(a, t):
    """Length of a vector across a unit vector ``t``; in a plane this needs no square root."""
    return abs(t[0] * a[1] - t[1] * a[0]) if len(a) == 2 else root(dot(a, a))


@unrolled
def cross(a, b):
    """Vector product; for two vectors in the plane of x and z, its component along y."""
    if len(a) == 2:
        return (a[1] * b[0] - a[0] * b[1],)
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@unrolled
def skew(a):
    """The matrix of the product a x b as a function of b: a block in space, a row of two in the plane."""
    if len(a) == 2:
        return (a[1], -a[0])
    return (0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0)


@unrolled
def transposed(a):
    """The transpose of a block in space, or of a row of two."""
    if len(a) == 2:
        return a
    return (a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8])


@unrolled
def times(a, b):
    """Product of two blocks in space, or of a row of two and a block in the plane."""
    if len(a) == 2:
        return (a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3])
    return (
        a[0] * b[0] + a[1] * b[3] + a[2] * b[6],
        a[0] * b[1] + a[1] * b[4] + a[2] * b[7],
        a[0] * b[2] + a[1] * b[5] + a[2] * b[8],
        a[3] * b[0] + a[4] * b[3] + a[5] * b[6],
        a[3] * b[1] + a[4] * b[4] + a[5] * b[7],
        a[3] * b[2] + a[4] * b[5] + a[5] * b[8],
        a[6] * b[0] + a[7] * b[3] + a[8] * b[6],
        a[6] * b[1] + a[7] * b[4] + a[8] * b[7],
        a[6] * b[2] + a[7] * b[5] + a[8] * b[8],
    )
