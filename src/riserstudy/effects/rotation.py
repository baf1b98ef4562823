"""The rotation vector that turns one direction into another, and its derivatives by both directions.

In the plane of x and z, the rotation vector has one component: the angle about y, from z towards x.

References
----------
Elementary: Euler's theorem for the rotation between two directions.
"""

from __future__ import annotations

from math import atan, sqrt

from riserstudy.solve.jit import inner
from riserstudy.solve.vec import add, at, cross, dot, mul, outer, skew, sub, times, transposed, unity


@inner
def angle_over_sine(cosine):
    """Ratio phi / sin(phi) for an angle phi with a given cosine, and its derivative by the cosine."""
    q = (1.0 - cosine) / (1.0 + cosine)  # the half angle's tangent squared
    if q < 0.05**2:
        ratio = 1.0 - q * (1 / 3 - q * (1 / 5 - q * (1 / 7 - q * (1 / 9 - q / 11))))
        slope = -1 / 3 + q * (2 / 5 - q * (3 / 7 - q * (4 / 9 - q * 5 / 11)))
    else:
        ratio = atan(sqrt(q)) / sqrt(q)
        slope = 0.5 * (1.0 / (1.0 + q) - ratio) / q
    twice = 2.0 / (1.0 + cosine)
    return twice * ratio, -0.5 * twice * twice * (twice * slope + ratio)


@inner
def rotation(a, b):
    """The vector of the rotation that takes unit vector a into b."""
    factor, _ = angle_over_sine(dot(a, b))
    return mul(factor, cross(a, b))


@inner
def rotation_by_first(a, b):
    """Derivative of `rotation` by a: block."""
    factor, slope = angle_over_sine(dot(a, b))
    return sub(mul(slope, outer(cross(a, b), b)), mul(factor, skew(b)))


@inner
def rotation_by_second(a, b):
    """Derivative of `rotation` by b: block."""
    factor, slope = angle_over_sine(dot(a, b))
    return add(mul(slope, outer(cross(a, b), a)), mul(factor, skew(a)))


@inner
def by_chord(s, e, by_direction):
    """Convert a derivative by a segment's direction to one by its chord, in the layout of the solver."""
    t = at(s.dim, s.tangent, e)
    turning = mul(s.inverse_length[e], sub(unity(s.dim), outer(t, t)))
    return transposed(times(by_direction, turning))
