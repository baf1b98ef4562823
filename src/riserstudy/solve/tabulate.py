"""Positions, tension, moments, shear and wall stress of an evaluated state, at nodes and between them."""

from __future__ import annotations

from math import pi, sqrt

from riserstudy.solve.jit import inner
from riserstudy.solve.state import of_pulls
from riserstudy.solve.vec import at, dot


@inner
def tabulate(s, record, values):
    """Positions, effective tension and moments at the nodes of an evaluated state; moments between nodes.

    Shear and stress are included if the record requests them.

    Tension at a node is a mean of the tensions of its segments by ``s.blend``, plus ``s.kink`` where sections
    of different weight meet. At the ends it is the force that holds the string, which includes weight, drag
    and inertia of the end node.
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
        else:  # no tension above: the tension of the segment below, continued to its end
            values[d, i] = below + (below - before) * s.l0[i - 1] / (s.l0[i - 1] + s.l0[max(i - 2, 0)])
        values[d, i] += s.kink[i] * s.tangent[d - 1, i - 1]
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
        values[row, n] = s.moment[u, n - 1] - of_pulls(s, u)
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
    """Row of component u of the k-th magnitude: moments at nodes and middles, shear above and below nodes."""
    return rows + 3 * k + u


@inner
def sizes(values, d, rows):
    """Magnitudes in space from their components."""
    for k in range((values.shape[0] - rows) // 3):
        for i in range(values.shape[1]):
            values[d + 1 + k, i] = sqrt(product(values, values, components(rows, k, 0), i))


@inner
def shear_forces(s, weights, side, u, values, row):
    """A component of shear above (side 0) or below each node; end nodes have one side."""
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
    """Largest stress at both radii and both sides (Pa), from effective tension, moment and pressures."""
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
    """Weighted sum of a component of the moments at nodes e - 1 to e + 2; weights (n, 4)."""
    last = s.l0.shape[0]
    value = 0.0
    for k in range(4):
        value += weights[e, k] * s.moment[u, min(max(e - 1 + k, 0), last)]
    if e == last - 1:
        value -= weights[e, 1] * of_pulls(s, u)
    return value


@inner
def product(one, other, row, i):
    """Scalar product of two moments whose components begin at a row."""
    return (
        one[row, i] * other[row, i]
        + one[row + 1, i] * other[row + 1, i]
        + one[row + 2, i] * other[row + 2, i]
    )
