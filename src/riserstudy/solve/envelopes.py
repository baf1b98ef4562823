"""Extremes over a simulation, from all time steps, with the parabola through three steps between them.

They do not depend on the interval of the outputs.
"""

from __future__ import annotations

from math import sqrt

from riserstudy.solve.jit import inner
from riserstudy.solve.tabulate import components, product

# ratio to the previous time step, from which on the parabola is not extrapolated over a step
UNEVEN = 2.5


@inner
def widen(record, places):
    """Include the tabulated time step in the envelopes.

    Between steps, a parabola through the last three steps gives the extremum of forces. Envelopes therefore
    have no larger error by long steps than histories. `widen_places` gives the extremum of positions. The
    magnitude of a vector opposite to the vector at the middle step counts as negative. A moment that swings
    through zero in space then has the same peaks as in a plane, and its smallest magnitude is near zero.

    Parameters
    ----------
    places : number of position rows, which come first.
    """
    values, largest, smallest = record.values, record.largest, record.smallest
    two_ago, last, when = record.past[0], record.past[1], record.when
    turning = record.seen[0] >= 2
    rows, first = largest.shape[0], places + 1  # first: row that in space is a magnitude
    over_left, over_right, over_both, even = 0.0, 0.0, 0.0, False
    if turning:
        # after a much shorter step, the slope is too uncertain for extrapolation
        even = when[2] - when[1] < UNEVEN * (when[1] - when[0])
        over_left, over_right = 1.0 / (when[1] - when[0]), 1.0 / (when[2] - when[1])
        over_both = 1.0 / (when[2] - when[0])
    sized = (values.shape[0] - rows) // 3
    for c in range(rows):
        is_size = first <= c < first + sized
        for i in range(values.shape[1]):
            here, middle, before = values[c, i], last[c, i], two_ago[c, i]
            largest[c, i] = max(largest[c, i], here)
            smallest[c, i] = min(smallest[c, i], here)
            if not turning or c < places:
                continue
            if is_size:
                row = components(rows, c - first, 0)
                smallest[c, i] = min(smallest[c, i], least_between(last, values, row, i))
                before = -before if product(two_ago, last, row, i) < 0.0 else before
                here = -here if product(values, last, row, i) < 0.0 else here
            left = (middle - before) * over_left
            right = (here - middle) * over_right
            bend = (right - left) * over_both
            rate = left + bend * (when[1] - when[0])  # at the middle step
            # a peak at the middle step, or of the parabola that also gives the outputs after it
            peaked = left * right < 0.0
            if peaked or (even and rate * (2.0 * right - rate) < 0.0):
                time, peak = when[1] - 0.5 * rate / bend, middle - 0.25 * rate * rate / bend
                if time >= record.time[0]:
                    smallest[c, i] = min(smallest[c, i], max(peak, 0.0) if is_size else peak)
                    largest[c, i] = max(largest[c, i], abs(peak) if is_size else peak)


@inner
def least_between(one, other, row, i):
    """Smallest magnitude between two moments, with linear interpolation of the vector."""
    along, square = 0.0, 0.0
    for u in range(3):
        way = other[row + u, i] - one[row + u, i]
        along -= one[row + u, i] * way
        square += way * way
    share = min(max(along / square, 0.0), 1.0) if square > 0.0 else 0.0
    size = 0.0
    for u in range(3):
        size += (one[row + u, i] + share * (other[row + u, i] - one[row + u, i])) ** 2
    return sqrt(size)


@inner
def widen_places(s, r0, v0, t, h, record):
    """Include the peaks of the cubic between two steps, which outputs also use, in the position envelopes."""
    for c in range(len(s.dim)):
        for i in range(record.largest.shape[1]):
            way = s.r[c, i] - r0[c, i]
            a, b = h * v0[c, i], h * s.v[c, i]
            # rate of the cubic over the step: a + 2 p x + 3 q x^2
            p, q = 3.0 * way - 2.0 * a - b, a + b - 2.0 * way
            inside = p * p - 3.0 * a * q
            if inside <= 0.0:
                continue
            # the root without cancellation, and the other root by their product
            big = -(p + sqrt(inside)) if p > 0.0 else -(p - sqrt(inside))
            for k in range(2):
                low, high = (big, 3.0 * q) if k == 0 else (a, big)
                if high == 0.0:
                    continue
                x = low / high
                if 0.0 < x < 1.0 and t + x * h >= record.time[0]:
                    peak = r0[c, i] + x * (a + x * (p + x * q))
                    record.largest[c, i] = max(record.largest[c, i], peak)
                    record.smallest[c, i] = min(record.smallest[c, i], peak)


@inner
def first_output(record):
    """Start the envelopes with an output between steps."""
    for c in range(record.largest.shape[0]):
        for i in range(record.between.shape[1]):
            record.largest[c, i] = record.between[c, i]
            record.smallest[c, i] = record.between[c, i]
