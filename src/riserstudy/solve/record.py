"""What a simulation writes down: envelopes at all nodes, histories at stations, ends at every step.

Extremes are those of the steps, with the parabola through three of them in between, and do not depend on
how often outputs are asked for. An output between steps has the positions of a cubic through both, and
forces of the parabola through the last three steps: forces of a state that is no equilibrium would be those
of the interpolation, not of the riser.
"""

from __future__ import annotations

from math import pi, sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.solve.evaluate import inertia, load, move, shape, true_moments
from riserstudy.solve.jit import inner, kernel
from riserstudy.solve.program import Frozen, every
from riserstudy.solve.state import know_internal
from riserstudy.solve.vec import at, dot

ROUNDING = 1e-10  # of a time (s)
UNEVEN = 2.5  # times as long as the step before, from which on it is not continued


class Record(NamedTuple):
    """Outputs; q quantities a node: position, effective tension, bending moment (in space its size).

    Where risers bend the last of them stands for the middle of the segment above each node. Where they are
    asked for, shear force above and below each node (it jumps at joints) and stress of the wall follow as
    the last of r rows. In space moments and shear are sizes; histories have the moment's components, too, and
    so has the scratch, in v rows: r, then three components of each size.
    """

    time: np.ndarray  # (k,) output times (s)
    station: np.ndarray  # (j,) node indices of the histories
    history: np.ndarray  # (k, quantities of a node, j)
    middle: np.ndarray  # (n, 4) what a moment at a middle takes of nodes e - 1 to e + 2
    shear: (
        np.ndarray
    )  # (2, n, 4) the same of shear at a segment's lower and upper end (1/m), or no n
    wall: (
        np.ndarray
    )  # (w, 6) radii outer, inner (m), area (m2), second moment (m4), two shares: `Section`
    wall_at: np.ndarray  # (w, 2) node, column of the contents or -1
    column: np.ndarray  # (c, 2) contents from the top down: weight (N/m3), level above (m) or NaN
    column_at: np.ndarray  # (c, 2) nodes of their upper and lower ends
    sea: np.ndarray  # (2,) weight (N/m3), elevation of the surface (m)
    largest: np.ndarray  # (r, n+1) envelopes from the first output on: q, then shear and stress
    smallest: np.ndarray  # (r, n+1) the same
    # end segment's tangent, moments of its end and inner node, length
    end: np.ndarray  # (k, 2, d + 2m + 1)
    top: np.ndarray  # (k, d) position of the top
    platform: np.ndarray  # (k, 6)
    probe: np.ndarray  # (k, probes)
    values: np.ndarray  # (v, n+1) scratch: the last step
    past: np.ndarray  # (2, v, n+1) scratch: the two steps before
    between: np.ndarray  # (v, n+1) scratch: an output between steps
    when: np.ndarray  # (3,) times of these three steps (s)
    inside: np.ndarray  # (c,) scratch: pressure at the upper ends of columns (Pa)
    seen: np.ndarray  # (1,) steps since the begin or the last event, across which forces may jump
    written: np.ndarray  # (1,) outputs written down
    # each step: what outputs have of ends and devices; as many as there is room for
    step_time: np.ndarray  # (t,) s
    step_end: np.ndarray  # (t, 2, d + 2m + 1)
    step_top: np.ndarray  # (t, d)
    step_platform: np.ndarray  # (t, 6)
    step_probe: np.ndarray  # (t, probes)
    steps: np.ndarray  # (1,) written down, more than there is room for where some are not


class Section(NamedTuple):
    """What shear force and stress of the wall follow from, as `Record` holds it."""

    shear: np.ndarray  # (2, n, 4) weights of moments (1/m)
    wall: (
        np.ndarray
    )  # (w, 6) radii (m), area (m2), second moment (m4), its shares of tension and moment
    wall_at: np.ndarray  # (w, 2) node, column
    column: np.ndarray  # (c, 2) weight (N/m3), level (m)
    column_at: np.ndarray  # (c, 2) nodes
    sea: np.ndarray  # (2,) weight (N/m3), elevation (m)


NO_SECTION = Section(
    np.zeros((2, 0, 4)),
    np.zeros((0, 6)),
    np.zeros((0, 2), np.int64),
    np.zeros((0, 2)),
    np.zeros((0, 2), np.int64),
    np.zeros(2),
)


def new_record(time, station, s, middle=None, section=NO_SECTION, room=0) -> Frozen:
    """Empty record for the sizes of a state, as compiled code takes it.

    Parameters
    ----------
    middle, section : see `Record`; absent: neither moments at middles nor shear and stress are recorded.
    room : steps of which ends and devices are recorded.
    """
    d, m, n = len(s.dim), len(s.dof) - len(s.dim), len(s.l0)
    q, k = d + 1 + 2 * min(m, 1), len(time)
    sheared = int(section.shear.shape[1] > 0)
    rows = q + 2 * sheared + int(len(section.wall) > 0)
    v = rows + (6 + 6 * sheared) * (m == 3)
    width = d + 2 * m + 1
    record = Record(
        time=np.array(time, float),
        station=np.array(station, np.int64),
        history=np.zeros((k, d + (1, 2, 0, 5)[m], len(station))),
        middle=np.zeros((n, 4)) if middle is None else np.array(middle, float),
        **section._asdict(),
        largest=np.full((rows, n + 1), -np.inf),
        smallest=np.full((rows, n + 1), np.inf),
        end=np.zeros((k, 2, width)),
        top=np.zeros((k, d)),
        platform=np.zeros((k, 6)),
        probe=np.zeros((k, len(s.probe))),
        values=np.zeros((v, n + 1)),
        past=np.zeros((2, v, n + 1)),
        between=np.zeros((v, n + 1)),
        when=np.zeros(3),
        inside=np.zeros(len(section.column)),
        seen=np.zeros(1, np.int64),
        written=np.zeros(1, np.int64),
        step_time=np.zeros(room),
        step_end=np.zeros((room, 2, width)),
        step_top=np.zeros((room, d)),
        step_platform=np.zeros((room, 6)),
        step_probe=np.zeros((room, len(s.probe))),
        steps=np.zeros(1, np.int64),
    )
    return Frozen(record)


@inner
def tabulate(s, record, values):
    """Positions, effective tension and moments at the nodes of an evaluated state; moments in between.

    Shear and stress, too, where they are asked for.

    Tension at a node lies between those of its segments by ``s.blend``; at the ends it is the force that
    holds the string there, so half a node of weight, drag and inertia is not lost.
    """
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
    sheared = record.shear.shape[1] > 0
    rows = record.largest.shape[0]
    for u in range(m):
        row = components(rows, 0, u) if m == 3 else d + 1
        for i in range(n + 1):
            values[row, i] = s.moment[u, i]
        row = components(rows, 1, u) if m == 3 else d + 2
        for e in range(n):
            values[row, e] = weighted(s, record.middle, u, e)
        values[row, n] = values[row, n - 1]
        if sheared:
            for side in range(2):
                row = components(rows, 2 + side, u) if m == 3 else d + 3 + side
                shear_forces(s, record.shear, side, u, values, row)
    if m == 3:
        sizes(values, d, rows)
    if record.wall.shape[0] > 0:
        wall_stresses(record, values, d, m, rows - 1)


@inner
def components(rows, k, u):
    """Row of component u of the k-th size: moments at nodes and middles, shear above and below nodes."""
    return rows + 3 * k + u


@inner
def sizes(values, d, rows):
    """Sizes in space from their components."""
    for k in range((values.shape[0] - rows) // 3):
        for i in range(values.shape[1]):
            values[d + 1 + k, i] = sqrt(product(values, values, components(rows, k, 0), i))


@inner
def shear_forces(s, weights, side, u, values, row):
    """A component of shear above (side 0) or below each node; ends have one side."""
    n = s.l0.shape[0]
    for i in range(n + 1):
        above = i < n and (side == 0 or i == 0)
        values[row, i] = weighted(s, weights[0 if above else 1], u, i if above else i - 1)


@inner
def wall_stresses(record, values, d, m, row):
    """Von Mises stress of the wall at the nodes; where two walls meet, the larger."""
    for i in range(values.shape[1]):
        values[row, i] = 0.0
    above = 0.0
    for k in range(record.column.shape[0]):
        upper = values[d - 1, record.column_at[k, 0]]
        if k == 0 and record.column[k, 1] == record.column[k, 1]:  # with a level
            above = record.column[k, 0] * (record.column[k, 1] - upper)
        elif k > 0:
            high, low = record.column_at[k - 1, 0], record.column_at[k - 1, 1]
            above += record.column[k - 1, 0] * (values[d - 1, high] - values[d - 1, low])
        record.inside[k] = above
    for w in range(record.wall.shape[0]):
        i, k = record.wall_at[w, 0], record.wall_at[w, 1]
        outside = max(record.sea[0] * (record.sea[1] - values[d - 1, i]), 0.0)
        inside = 0.0
        if k >= 0:
            height = values[d - 1, record.column_at[k, 0]] - values[d - 1, i]
            inside = max(record.inside[k] + record.column[k, 0] * height, 0.0)
        moment = values[d + 1, i] if m > 0 else 0.0
        stress = von_mises(record.wall, w, values[d, i], abs(moment), inside, outside)
        values[row, i] = max(values[row, i], stress)


@inner
def von_mises(wall, w, tension, moment, inside, outside):
    """The largest of both radii and both sides (Pa), from effective tension, moment and pressures."""
    outer, inner_radius, area = wall[w, 0], wall[w, 1], wall[w, 2]
    o, i = outer * outer, inner_radius * inner_radius
    axial = (wall[w, 4] * tension + pi * (inside * i - outside * o)) / area
    even = (inside * i - outside * o) / (o - i)
    largest = 0.0
    for c in range(4):
        radius = outer if c < 2 else inner_radius
        bent = wall[w, 5] * moment * radius / wall[w, 3]
        along = axial + (bent if c % 2 == 0 else -bent)
        varying = (inside - outside) * i * o / ((o - i) * radius * radius)
        hoop, radial = even + varying, even - varying
        square = (along - hoop) ** 2 + (hoop - radial) ** 2 + (radial - along) ** 2
        largest = max(largest, square)
    return sqrt(0.5 * largest)


@inner
def weighted(s, weights, u, e):
    """Sum of a component of the moments at nodes e - 1 to e + 2 by weights, (n, 4)."""
    last = s.l0.shape[0]
    value = 0.0
    for k in range(4):
        value += weights[e, k] * s.moment[u, min(max(e - 1 + k, 0), last)]
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
def remember(record):
    """Let the last step be one before the next."""
    values, past, when = record.values, record.past, record.when
    for c in range(values.shape[0]):
        for i in range(values.shape[1]):
            past[0, c, i] = past[1, c, i]
            past[1, c, i] = values[c, i]
    when[0], when[1] = when[1], when[2]
    record.seen[0] += 1


@inner
def note(p, s, record, values):
    """Write tabulated values down as the next output."""
    k = record.written[0]
    record.written[0] += 1
    d = len(s.dim)
    m = len(s.dof) - d
    every(p.probe, s)
    for j in range(record.station.shape[0]):
        i = record.station[j]
        for c in range(d + 1 + min(m, 1)):
            record.history[k, c, j] = values[c, i]
        if m == 3:
            for u in range(3):
                row = components(record.largest.shape[0], 0, u)
                record.history[k, d + 2 + u, j] = values[row, i]
    ends(s, k, record.end, record.top, record.platform, record.probe)


@inner
def ends(s, k, end, top, platform, probe):
    """Write ends, platform and what devices report down in row k."""
    d, n = len(s.dim), s.l0.shape[0]
    m = len(s.dof) - d
    for c in range(d):
        end[k, 0, c] = s.tangent[c, 0]
        end[k, 1, c] = s.tangent[c, n - 1]
        top[k, c] = s.r[c, n]
    if m == 0:
        string_ends(s, k, end)
    for u in range(m):
        end[k, 0, d + u], end[k, 0, d + m + u] = s.moment[u, 0], s.moment[u, 1]
        # a telescopic joint starts with the ring's moment less that of the cylinders
        about = s.ring_moment[u] if m == 3 else s.ring_moment[1]
        end[k, 1, d + u] = s.moment[u, n]
        end[k, 1, d + m + u] = s.moment[u, n - 1] - about
    end[k, 0, d + 2 * m], end[k, 1, d + 2 * m] = s.length[0], s.length[n - 1]
    for c in range(6):
        platform[k, c] = s.platform[0, c]
    for c in range(s.probe.shape[0]):
        probe[k, c] = s.probe[c]


@inner
def string_ends(s, k, end):
    """A string's directions at its ends: those of the forces that hold it there.

    The end segments' own directions are those of their middles, an error of first order in their length.
    """
    d, n = len(s.dim), s.l0.shape[0]
    for side in range(2):
        sign, e = (1.0, 0) if side == 0 else (-1.0, n - 1)
        square, along = 0.0, 0.0
        for c in range(d):
            force = sign * (s.ends[0, side, c] + s.ends[1, side, c])
            square += force * force
            along += force * s.tangent[c, e]
        size = sqrt(square)
        if along > 0.9 * size:  # else it is slack, and has no such direction
            for c in range(d):
                force = sign * (s.ends[0, side, c] + s.ends[1, side, c])
                end[k, side, c] = force / size


@inner
def note_ends(p, s, record, time):
    """Write a step's ends down where there is room for them."""
    k = record.steps[0]
    if record.step_time.shape[0] == 0:
        return
    record.steps[0] += 1
    if k < record.step_time.shape[0]:
        every(p.probe, s)
        record.step_time[k] = time
        ends(s, k, record.step_end, record.step_top, record.step_platform, record.step_probe)


@inner
def due(record, time):
    """Whether the next output is due before a time."""
    k = record.written[0]
    return k < record.time.shape[0] and record.time[k] < time


@inner
def evaluate_and_note(p, s, record):
    """The next output, of a state given by positions, velocities and true accelerations."""
    move(p, s, record.time[record.written[0]])
    evaluate(p, s, record, record.values)
    note(p, s, record, record.values)


@inner
def evaluate(p, s, record, values):
    """Forces of a state as it stands, tabulated."""
    shape(p, s)
    true_moments(s)
    load(p, s)
    inertia(p, s)
    tabulate(s, record, values)


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


@inner
def interpolate_carried(s, carried0, t0, carried1, t1, time):
    """The same of first-order motion, so that the top without it is on the cubic of the steps, too."""
    h = t1 - t0
    x = (time - t0) / h
    for k in range(len(s.dim)):
        d = carried1[0, k] - carried0[0, k]
        slope, twist = h * carried0[1, k] - d, d - h * carried1[1, k]
        bump = slope * (1.0 - x) + twist * x
        s.carried[0, k] = carried0[0, k] + x * d + x * (1.0 - x) * bump
        s.carried[1, k] = (d + (1.0 - 2.0 * x) * bump + x * (1.0 - x) * (twist - slope)) / h
        s.carried[2, k] = (1.0 - x) * carried0[2, k] + x * carried1[2, k]


@inner
def interpolate_internal(so, before, t0, s, t1, time):
    """The same of internal variables, by their rates."""
    h = t1 - t0
    x = (time - t0) / h
    for k in range(s.internal.shape[0]):
        for i in range(s.internal.shape[1]):
            d = s.internal[k, i] - before.internal[k, i]
            slope = h * before.internal_rate[k, i] - d
            twist = d - h * s.internal_rate[k, i]
            bump = slope * (1.0 - x) + twist * x
            so.internal[k, i] = before.internal[k, i] + x * d + x * (1.0 - x) * bump
    know_internal(so)


@kernel
def evaluate_once(p, s, record):
    """Tabulate and note a state as it stands, for callers in Python."""
    evaluate(p, s, record, record.values)
    note(p, s, record, record.values)


@inner
def between(p, s, so, before, t, h, record):
    """Write down the outputs due within a step from t to t + h, where ``s`` is, and is tabulated.

    ``so`` is a second state of the same model, which takes the interpolated positions.
    """
    while due(record, t + h * (1.0 - 1e-9)):
        time = record.time[record.written[0]]
        x = (time - t) / h
        move(p, so, time)
        interpolate(
            so, before.r, before.v, before.a, t, s.r, s.v, s.a, t + h, time
        )  # held nodes, too, as `widen_places`
        interpolate_carried(so, before.carried, t, s.carried, t + h, time)
        interpolate_internal(so, before, t, s, t + h, time)
        for u in range(len(s.dof) - len(s.dim)):
            for i in range(s.l0.shape[0] + 1):
                so.moment[u, i] = (1.0 - x) * before.moment[u, i] + x * s.moment[u, i]
        evaluate(p, so, record, record.between)
        forces_of_steps(s, record, time)
        note(p, so, record, record.between)
        if (
            record.written[0] == 1
        ):  # envelopes begin with the first output, not with the step after it
            first_output(record)


@inner
def forces_of_steps(s, record, time):
    """Forces at a time within the last step: the parabola through three steps, or straight after one."""
    d, values, past, when = len(s.dim), record.values, record.past, record.when
    x = (time - when[1]) / (when[2] - when[1])
    bend = 0.0
    if record.seen[0] >= 2 and when[2] - when[1] < UNEVEN * (when[1] - when[0]):
        bend = (time - when[1]) * (time - when[2]) / (when[2] - when[0])
    for c in range(d, values.shape[0]):
        for i in range(values.shape[1]):
            rise = values[c, i] - past[1, c, i]
            value = past[1, c, i] + x * rise
            if bend != 0.0:
                slope, before = rise / (when[2] - when[1]), past[1, c, i] - past[0, c, i]
                value += bend * (slope - before / (when[1] - when[0]))
            record.between[c, i] = value
    if len(s.dof) - d == 3:
        sizes(record.between, d, record.largest.shape[0])


@inner
def first_output(record):
    """Begin the envelopes with an output between steps."""
    for c in range(record.largest.shape[0]):
        for i in range(record.between.shape[1]):
            record.largest[c, i] = record.between[c, i]
            record.smallest[c, i] = record.between[c, i]


@inner
def note_start(p, s, record, t):
    """Write down the state that a march begins with, unless it goes on from steps that were seen.

    At a jolt or an event the state just after it is left out: a mesh's answer to an acceleration that jumps
    is no riser's.
    """
    if record.seen[0] > 0:
        return
    record.when[2] = t
    tabulate(s, record, record.values)
    if t >= record.time[0] - ROUNDING:
        widen(record, len(s.dim))
        note_ends(p, s, record, t)
    if due(record, t + ROUNDING):
        note(p, s, record, record.values)
    remember(record)


def forget(record: Frozen) -> None:
    """Keep the last step alone: forces have a kink or a jump there, at a jolt or an event."""
    record.value.seen[0] = min(record.value.seen[0], 1)


@inner
def note_step(p, s, so, before, t, h, record):
    """Write down a step from t to t + h, where ``s`` is evaluated."""
    record.when[2] = t + h
    tabulate(s, record, record.values)
    between(p, s, so, before, t, h, record)
    if t + h >= record.time[0] - ROUNDING:  # envelopes begin with the outputs
        widen(record, len(s.dim))
        widen_places(s, before.r, before.v, t, h, record)
        note_ends(p, s, record, t + h)
    if due(record, t + h * (1.0 + 1e-9)):
        note(p, s, record, record.values)
    remember(record)
