"""Small vectors and square blocks as tuples of floats, unrolled by their length while compiling.

A vector has as many numbers as the model has directions (1, 2 or 3), a block their square, row by
row. Written once, an effect so serves axial, planar and spatial models at no cost in run time.
"""

from __future__ import annotations

from math import sqrt

from numba.core import types
from numba.extending import overload, register_jitable


def unrolled(body):
    """Give a function on tuples a compiled twin; ``body(n)`` is its text for a first tuple of length n.

    The plain function stays what Python runs when compiling is switched off.
    """

    def register(function):
        names = ", ".join(function.__code__.co_varnames[: function.__code__.co_argcount])

        def twin(arguments):
            length = next(a.count for a in arguments if isinstance(a, types.BaseTuple))
            scope = {}
            exec(f"def twin({names}):\n    {body(length)}", scope)
            return scope["twin"]

        scope = {"twin": twin}
        exec(f"def choose({names}):\n    return twin([{names}])", scope)
        overload(function)(scope["choose"])
        return function

    return register


def _each(item, join=", "):
    """Text of ``item`` for k = 0 ... n-1 in place of #."""
    return lambda n: join.join(item.replace("#", str(k)) for k in range(n))


def _tuple(item):
    return lambda n: f"return ({_each(item)(n)},)"


def _square(item):
    return lambda n: (
        "return (" + "".join(item(i, j) + "," for i in range(n) for j in range(n)) + ")"
    )


@unrolled(_tuple("a[#] + b[#]"))
def add(a, b):
    """Sum of two vectors or two blocks."""
    return tuple(x + y for x, y in zip(a, b, strict=True))


@unrolled(_tuple("a[#] - b[#]"))
def sub(a, b):
    """Difference of two vectors or two blocks."""
    return tuple(x - y for x, y in zip(a, b, strict=True))


@unrolled(_tuple("factor * a[#]"))
def mul(factor, a):
    """Vector or block times a number."""
    return tuple(factor * x for x in a)


@unrolled(lambda n: "return " + _each("a[#] * b[#]", " + ")(n))
def dot(a, b):
    """Scalar product."""
    return sum(x * y for x, y in zip(a, b, strict=True))


@unrolled(_square(lambda i, j: f"a[{i}] * b[{j}]"))
def outer(a, b):
    """Block a bᵀ."""
    return tuple(x * y for x in a for y in b)


@unrolled(_square(lambda i, j: str(float(i == j))))
def unity(a):
    """Unit block for vectors like ``a``."""
    return tuple(float(i == j) for i in range(len(a)) for j in range(len(a)))


@unrolled(lambda n: f"return {(0.0,) * (n - 1) + (1.0,)}")
def upward(a):
    """Unit vector up, the last direction, for vectors like ``a``."""
    return (0.0,) * (len(a) - 1) + (1.0,)


@unrolled(_tuple("array[#, i]"))
def at(like, array, i):
    """Vector i of a component-major array (directions, nodes); ``like`` tells the directions."""
    return tuple(array[k, i] for k in range(len(like)))


@unrolled(_each("array[#, i] = a[#]", "; "))
def put(array, i, a):
    """Store a vector in a component-major array."""
    for k, x in enumerate(a):
        array[k, i] = x


@unrolled(_each("array[#, i] += a[#]", "; "))
def plus(array, i, a):
    """Add a vector to a component-major array."""
    for k, x in enumerate(a):
        array[k, i] += x


@unrolled(_each("array[i, #] = a[#]", "; "))
def put_block(array, i, a):
    """Store a block in row i of an array (rows, directions squared)."""
    for k, x in enumerate(a):
        array[i, k] = x


@unrolled(_each("array[i, #] += a[#]", "; "))
def plus_block(array, i, a):
    """Add a block to row i of an array (rows, directions squared)."""
    for k, x in enumerate(a):
        array[i, k] += x


@register_jitable
def norm(a):
    """Length of a vector."""
    return sqrt(dot(a, a))


@register_jitable
def cross(a, b):
    """Vector product of two vectors in space."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


@register_jitable
def skew(a):
    """Block of a vector in space: skew(a) b = a x b."""
    return (0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0)


@register_jitable
def transposed(a):
    """A block in space, rows and columns exchanged."""
    return (a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8])


@register_jitable
def times(a, b):
    """Product of two blocks in space."""
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
