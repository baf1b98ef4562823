"""Exponential, sine and cosine as polynomials, which a compiler evaluates for several numbers at a time.

Library functions are called number by number; without these polynomials, they would dominate the time of sums
over many waves at many nodes. Arguments are halved until a short Taylor series is exact to rounding, and
results are squared or doubled as often.
"""

from __future__ import annotations

from math import pi

from riserstudy.solve.unroll import floor, unrolled


@unrolled
def exponential(x):
    """exp(x), for x from -80 to 0."""
    y = x / 256.0
    p = 1.0 + y / 11.0 * (1.0 + y / 12.0)
    p = 1.0 + y / 8.0 * (1.0 + y / 9.0 * (1.0 + y / 10.0 * p))
    p = 1.0 + y / 5.0 * (1.0 + y / 6.0 * (1.0 + y / 7.0 * p))
    p = 1.0 + y / 2.0 * (1.0 + y / 3.0 * (1.0 + y / 4.0 * p))
    p = 1.0 + y * p
    p *= p
    p *= p
    p *= p
    p *= p
    p *= p
    p *= p
    p *= p
    return p * p


@unrolled
def within_a_turn(angle):
    """An angle reduced to the range from minus pi to pi (rad)."""
    return angle - 2.0 * pi * floor(angle / (2.0 * pi) + 0.5)


@unrolled
def sine_and_cosine(angle):
    """Sine and cosine of an angle (rad), as exact as the angle itself."""
    y = 0.125 * within_a_turn(angle)
    q = y * y
    s = 1.0 - q / 72.0 * (1.0 - q / 110.0 * (1.0 - q / 156.0))
    s = y * (1.0 - q / 6.0 * (1.0 - q / 20.0 * (1.0 - q / 42.0 * s)))
    c = 1.0 - q / 90.0 * (1.0 - q / 132.0 * (1.0 - q / 182.0))
    c = 1.0 - q / 2.0 * (1.0 - q / 12.0 * (1.0 - q / 30.0 * (1.0 - q / 56.0 * c)))
    s, c = 2.0 * s * c, 1.0 - 2.0 * s * s
    s, c = 2.0 * s * c, 1.0 - 2.0 * s * s
    return 2.0 * s * c, 1.0 - 2.0 * s * s
