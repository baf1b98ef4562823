"""What a simulation writes down: envelopes at all nodes, histories at stations."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.solve.evaluate import inertia, load, move, shape, true_moments
from riserstudy.solve.jit import inner, kernel
from riserstudy.solve.program import Frozen, every
from riserstudy.solve.vec import at, dot

ROUNDING = 1e-10  # of a time (s)


class Record(NamedTuple):
    """Outputs; q quantities a node: position, effective tension, bending moment (in space its size).

    Where risers bend the last of them stands for the middle of the segment above each node. Histories in
    space have the moment's components, too, and so has the scratch: in v rows, q without components.
    """

    time: np.ndarray  # (k,) output times (s)
    station: np.ndarray  # (j,) node indices of the histories
    history: np.ndarray  # (k, quantities of a node, j)
    middle: np.ndarray  # (n, 4) what a moment at a middle takes of nodes e - 1 to e + 2
    largest: np.ndarray  # (q, n+1) envelopes from the first output on
    smallest: np.ndarray  # (q, n+1)
    # end segment's tangent, moments of its end and inner node, length
    end: np.ndarray  # (k, 2, d + 2m + 1)
    top: np.ndarray  # (k, d) position of the top
    platform: np.ndarray  # (k, 6)
    probe: np.ndarray  # (k, probes)
    values: np.ndarray  # (v, n+1) scratch
    past: np.ndarray  # (2, v, n+1) scratch: the two steps before
    seen: np.ndarray  # (1,) steps that the envelopes have seen
    written: np.ndarray  # (1,) outputs written down


def new_record(time, station, s, middle=None) -> Frozen:
    """Empty record for the sizes of a state, as compiled code takes it; no ``middle``: none is told."""
    d, m, n = len(s.dim), len(s.dof) - len(s.dim), len(s.l0)
    q, k = d + 1 + 2 * min(m, 1), len(time)
    v = q + 6 * (m == 3)
    record = Record(
        time=np.array(time, float),
        station=np.array(station, np.int64),
        history=np.zeros((k, d + 1 + (0, 1, 0, 4)[m], len(station))),
        middle=np.zeros((n, 4)) if middle is None else np.array(middle, float),
        largest=np.full((q, n + 1), -np.inf),
        smallest=np.full((q, n + 1), np.inf),
        end=np.zeros((k, 2, d + 2 * m + 1)),
        top=np.zeros((k, d)),
        platform=np.zeros((k, 6)),
        probe=np.zeros((k, len(s.probe))),
        values=np.zeros((v, n + 1)),
        past=np.zeros((2, v, n + 1)),
        seen=np.zeros(1, np.int64),
        written=np.zeros(1, np.int64),
    )
    return Frozen(record)


@inner
def tabulate(s, record):
    """Positions, effective tension and moments at the nodes of an evaluated state; moments in between.

    Tension at a node lies between those of its segments by ``s.blend``; at the ends it is the force that
    holds the string there, so half a node of weight, drag and inertia is not lost.
    """
    values = record.values
    d, n = len(s.dim), s.l0.shape[0]
    for c in range(d):
        for i in range(n + 1):
            values[c, i] = s.r[c, i]
    below = dot(at(s.dim, s.segment, 0), at(s.dim, s.tangent, 0))
    before = below
    for i in range(1, n):
        above = dot(at(s.dim, s.segment, i), at(s.dim, s.tangent, i))
        if s.blend[i] > 0.0:
            values[d, i] = below + s.blend[i] * (above - below)
        else:  # no tension above: that below, carried on to its end
            values[d, i] = below + (below - before) * s.l0[i - 1] / (
                s.l0[i - 1] + s.l0[max(i - 2, 0)]
            )
        before, below = below, above
    values[d, 0], values[d, n] = 0.0, 0.0
    for c in range(d):
        values[d, 0] += (s.ends[0, 0, c] + s.ends[1, 0, c]) * s.tangent[c, 0]
        values[d, n] -= (s.ends[0, 1, c] + s.ends[1, 1, c]) * s.tangent[c, n - 1]
    m = len(s.dof) - d
    if m > 0:
        for u in range(m):
            row = d + 1 if m == 1 else d + 3 + u
            for i in range(n + 1):
                values[row, i] = s.moment[u, i]
            row += m
            for e in range(n):
                values[row, e] = between_nodes(s, record.middle, u, e)
            values[row, n] = values[row, n - 1]
    if m == 3:
        for c in range(2):
            for i in range(n + 1):
                values[d + 1 + c, i] = sqrt(product(values, values, d + 3 + 3 * c, i))


@inner
def between_nodes(s, middle, u, e):
    """A component of the moment at the middle of a segment."""
    last = s.l0.shape[0]
    value = 0.0
    for k in range(4):
        value += middle[e, k] * s.moment[u, min(max(e - 1 + k, 0), last)]
    return value


@inner
def product(one, other, row, i):
    """Product of two moments whose components stand from a row on."""
    return (
        one[row, i] * other[row, i]
        + one[row + 1, i] * other[row + 1, i]
        + one[row + 2, i] * other[row + 2, i]
    )


@inner
def widen(record):
    """Take the tabulated values into the envelopes.

    Between steps a parabola through the last three tells the extremum, so that envelopes lose no more to
    long steps than histories do. A size that points the other way than the middle one counts as negative
    there: what swings through zero has the peaks that it has in a plane.
    """
    values, largest, smallest = record.values, record.largest, record.smallest
    two_ago, last = record.past[0], record.past[1]
    turning = record.seen[0] >= 2
    q = largest.shape[0]
    sized = values.shape[0] > q  # the last two rows are sizes
    for c in range(q):
        for i in range(values.shape[1]):
            here, middle, before = values[c, i], last[c, i], two_ago[c, i]
            largest[c, i] = max(largest[c, i], here)
            smallest[c, i] = min(smallest[c, i], here)
            if turning:
                is_size = sized and c >= q - 2
                if is_size:
                    row = q + 3 * (c - q + 2)
                    before = -before if product(two_ago, last, row, i) < 0.0 else before
                    here = -here if product(values, last, row, i) < 0.0 else here
                rise, fall = middle - before, middle - here
                if rise * fall > 0.0:
                    peak = middle + (rise - fall) ** 2 / (8.0 * (rise + fall))
                    peak = abs(peak) if is_size else peak
                    largest[c, i] = max(largest[c, i], peak)
                    smallest[c, i] = min(smallest[c, i], peak)
    for c in range(values.shape[0]):
        for i in range(values.shape[1]):
            two_ago[c, i] = last[c, i]
            last[c, i] = values[c, i]
    record.seen[0] += 1


@inner
def note(p, s, record):
    """Write the tabulated values down as the next output."""
    k = record.written[0]
    record.written[0] += 1
    d, n = len(s.dim), s.l0.shape[0]
    m = len(s.dof) - d
    every(p.probe, s)
    for j in range(record.station.shape[0]):
        i = record.station[j]
        for c in range(d + 1 + min(m, 1)):
            record.history[k, c, j] = record.values[c, i]
        if m == 3:
            for u in range(3):
                record.history[k, d + 2 + u, j] = s.moment[u, i]
    for c in range(d):
        record.end[k, 0, c] = s.tangent[c, 0]
        record.end[k, 1, c] = s.tangent[c, n - 1]
        record.top[k, c] = s.r[c, n]
    for u in range(m):
        record.end[k, 0, d + u], record.end[k, 0, d + m + u] = s.moment[u, 0], s.moment[u, 1]
        # a telescopic joint starts with the ring's moment less that of the cylinders
        about = s.ring_moment[u] if m == 3 else s.ring_moment[1]
        record.end[k, 1, d + u] = s.moment[u, n]
        record.end[k, 1, d + m + u] = s.moment[u, n - 1] - about
    record.end[k, 0, d + 2 * m], record.end[k, 1, d + 2 * m] = s.length[0], s.length[n - 1]
    for c in range(6):
        record.platform[k, c] = s.platform[0, c]
    for c in range(s.probe.shape[0]):
        record.probe[k, c] = s.probe[c]


@inner
def due(record, time):
    """Whether the next output is due before a time."""
    k = record.written[0]
    return k < record.time.shape[0] and record.time[k] < time


@inner
def evaluate_and_note(p, s, record):
    """The next output, of a state given by positions, velocities and true accelerations."""
    move(p, s, record.time[record.written[0]])
    evaluate(p, s, record)
    note(p, s, record)


@inner
def evaluate(p, s, record):
    """Forces of a state as it stands, tabulated."""
    shape(p, s)
    true_moments(s)
    load(p, s)
    inertia(p, s)
    tabulate(s, record)


@inner
def interpolate(s, r0, v0, a0, t0, r1, v1, a1, t1, time):
    """Cubic interpolation of positions between two steps; velocity is its derivative."""
    h = t1 - t0
    x = (time - t0) / h
    for k in range(len(s.dim)):
        for i in range(s.r.shape[1]):
            d = r1[k, i] - r0[k, i]
            slope, twist = h * v0[k, i] - d, d - h * v1[k, i]
            bump = slope * (1.0 - x) + twist * x
            s.r[k, i] = r0[k, i] + x * d + x * (1.0 - x) * bump
            s.v[k, i] = (d + (1.0 - 2.0 * x) * bump + x * (1.0 - x) * (twist - slope)) / h
            s.a[k, i] = (1.0 - x) * a0[k, i] + x * a1[k, i]


@kernel
def evaluate_once(p, s, record):
    """Tabulate and note a state as it stands, for callers in Python."""
    evaluate(p, s, record)
    note(p, s, record)


@inner
def between(p, s, so, r0, v0, a0, moment0, t, h, record):
    """Write down the outputs due within a step from t to t + h, where ``s`` is.

    ``so`` is a second state of the same model, which takes the interpolated positions.
    """
    while due(record, t + h * (1.0 - 1e-9)):
        time = record.time[record.written[0]]
        x = (time - t) / h
        interpolate(so, r0, v0, a0, t, s.r, s.v, s.a, t + h, time)
        for u in range(len(s.dof) - len(s.dim)):
            for i in range(s.l0.shape[0] + 1):
                so.moment[u, i] = (1.0 - x) * moment0[u, i] + x * s.moment[u, i]
        evaluate_and_note(p, so, record)
        if record.seen[0] == 0:  # envelopes start with the first output, not with the step after it
            widen(record)
            record.seen[0] = 0


@inner
def note_start(p, s, record, t):
    """Write down the state that a march begins with, where an output is due there."""
    if due(record, t + ROUNDING):
        tabulate(s, record)
        widen(record)
        note(p, s, record)


@inner
def note_step(p, s, so, r0, v0, a0, moment0, t, h, record):
    """Write down a step from t to t + h, where ``s`` is evaluated."""
    between(p, s, so, r0, v0, a0, moment0, t, h, record)
    if t + h >= record.time[0] - ROUNDING:  # envelopes start with the outputs
        tabulate(s, record)
        widen(record)
    if due(record, t + h * (1.0 + 1e-9)):
        note(p, s, record)
