"""Extremes over a simulation: those of the steps, with the parabola through three of them in between.

They do not depend on how often outputs are requested.
"""

from __future__ import annotations

from math import sqrt

from riserstudy.solve.jit import inner
from riserstudy.solve.tabulate import components, product

UNEVEN = 2.5  # times as long as the step before, from which on it is not continued


@inner
def widen(record, places):
    """Take the tabulated step into the envelopes.

    Between steps a parabola through the last three gives the extremum of forces, so that envelopes lose no
    more to long steps than histories do; that of positions is `widen_places`'s. A size that points the other
    way than the middle one counts as negative there: what swings through zero has the peaks that it has in a
    plane, and is as small as between them.

    Parameters
    ----------
    places : positions of a node, the first of the rows.
    """
    values, largest, smallest = record.values, record.largest, record.smallest
    two_ago, last, when = record.past[0], record.past[1], record.when
    turning = record.seen[0] >= 2
    rows, first = largest.shape[0], places + 1  # the first that in space is a size
    over_left, over_right, over_both, even = 0.0, 0.0, 0.0, False
    if turning:
        # after a much shorter step its slope is too uncertain to go on by
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
            # a peak at the middle step, or of the parabola that outputs after it are taken from
            peaked = left * right < 0.0
            if peaked or (even and rate * (2.0 * right - rate) < 0.0):
                time, peak = when[1] - 0.5 * rate / bend, middle - 0.25 * rate * rate / bend
                if time >= record.time[0]:
                    smallest[c, i] = min(smallest[c, i], max(peak, 0.0) if is_size else peak)
                    largest[c, i] = max(largest[c, i], abs(peak) if is_size else peak)


@inner
def least_between(one, other, row, i):
    """Smallest size between two moments, straight from one to the other."""
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
    """Take the peaks of the cubic between two steps into the envelopes of positions, as outputs have it."""
    for c in range(len(s.dim)):
        for i in range(record.largest.shape[1]):
            way = s.r[c, i] - r0[c, i]
            a, b = h * v0[c, i], h * s.v[c, i]
            # the cubic's rate over the step: a + 2 p x + 3 q x^2
            p, q = 3.0 * way - 2.0 * a - b, a + b - 2.0 * way
            inside = p * p - 3.0 * a * q
            if inside <= 0.0:
                continue
            # a root that does not cancel, and the other one by their product
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
    """Begin the envelopes with an output between steps."""
    for c in range(record.largest.shape[0]):
        for i in range(record.between.shape[1]):
            record.largest[c, i] = record.between[c, i]
            record.smallest[c, i] = record.between[c, i]
