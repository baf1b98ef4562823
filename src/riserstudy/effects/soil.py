r"""Soil around a conductor: springs that resist the lateral displacement y of its nodes.

The springs have the resistance p per length. The springs are linear, :math:`p = k\,y`, or follow a p-y curve
(resistance over displacement). For soft clay under static load, the p-y curve is Matlock's curve,

.. math:: p = \tfrac12\,p_u\,(y/y_{50})^{1/3},\qquad p \le p_u,

The stiffness of Matlock's curve at y = 0 is infinite, so a straight line replaces the curve up to a small
:math:`y_0`. Beyond the last point, the p-y curves of sand and of tables are constant. Up to the last point,
p-y curves of sand and of tables consist of cubic pieces,

.. math:: p(y) = a_k t^3 + b_k t^2 + c_k t + d_k, \qquad t = y - y_k.

References
----------
Matlock (1970), OTC 1204; API RP 2A-WSD, section 6.8.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner

YIELD = 8.0  # y / y50 at which p reaches p_u


class LinearSoil(NamedTuple):
    """Springs of constant stiffness."""

    node: np.ndarray  # (k,)
    stiffness: np.ndarray  # (k,) times the length of conductor that they represent (N/m)


class SoftClay(NamedTuple):
    """Matlock's springs."""

    node: np.ndarray  # (k,)
    ultimate: np.ndarray  # (k,) p_u times length (N)
    y50: np.ndarray  # (k,) displacement at half of p_u (m)
    origin: float  # y_0 / y50 (1)


class TabulatedSprings(NamedTuple):
    """Springs by tables, one for each node."""

    node: np.ndarray  # (k,)
    places: np.ndarray  # (k, j + 1) displacements at which pieces begin and end, from zero (m)
    force: np.ndarray  # (4, k, j) a, b, c, d of each piece, times length (N, m)
    energy: np.ndarray  # (5, k, j) the same for the integral from zero (J, m)


@inner
def _away(s, i):
    """Distance of a node from the initial axis of the conductor."""
    square = 0.0
    for c in range(len(s.dim) - 1):
        square += s.r[c, i] ** 2
    return sqrt(square)


@inner
def _resist(s, i, y, p):
    """Apply a force p at node i against its displacement of magnitude y."""
    for c in range(len(s.dim) - 1):
        s.force[c, i] -= p * s.r[c, i] / y
    return 0.0


@inner
def _stiffen(s, i, y, p, slope):
    """Stiffness of node i: the slope along its displacement of magnitude y, and p / y across it."""
    d = len(s.dim)
    across = p / y if y > 0.0 else slope
    for a in range(d - 1):
        s.k_node[i, a * d + a] += across
        if y > 0.0:
            for b in range(d - 1):
                s.k_node[i, a * d + b] += (slope - across) * s.r[a, i] * s.r[b, i] / (y * y)
    return 0.0


@inner
def py_of_table(soil, k, y):
    """Resistance, its slope by y and its energy."""
    count = soil.force.shape[2]
    last = soil.places[k, count]
    piece = count - 1
    for j in range(count - 1):
        if y < soil.places[k, j + 1]:
            piece = j
            break
    t = min(y, last) - soil.places[k, piece]
    force, energy = soil.force, soil.energy
    p, slope, stored = 0.0, 0.0, 0.0
    for row in range(4):
        slope = slope * t + p
        p = p * t + force[row, k, piece]
    for row in range(5):
        stored = stored * t + energy[row, k, piece]
    if y >= last:
        return p, 0.0, stored + p * (y - last)
    return p, slope, stored


@inner
def table_force(soil, s):
    """Resistance against the displacement."""
    for k in range(soil.node.shape[0]):
        y = _away(s, soil.node[k])
        if y > 0.0:
            p, _, _ = py_of_table(soil, k, y)
            _resist(s, soil.node[k], y, p)
    return 0.0


@inner
def table_tangent(soil, s):
    """Slope along the displacement, p / y across it."""
    for k in range(soil.node.shape[0]):
        y = _away(s, soil.node[k])
        p, slope, _ = py_of_table(soil, k, y)
        _stiffen(s, soil.node[k], y, p, slope)
    return 0.0


@inner
def table_energy(soil, s):
    """Work done on the springs (J)."""
    total = 0.0
    for k in range(soil.node.shape[0]):
        _, _, stored = py_of_table(soil, k, _away(s, soil.node[k]))
        total += stored
    return total


@inner
def py_of_clay(soil, k, y):
    """Resistance, its slope by y and its energy."""
    q, q0 = y / soil.y50[k], soil.origin
    p, y50 = soil.ultimate[k], soil.y50[k]
    first = 0.5 * q0 ** (1.0 / 3.0)
    if q <= q0:
        return p * first * q / q0, p * first / (q0 * y50), 0.5 * p * y50 * first * q * q / q0
    q = min(q, YIELD)
    root = q ** (1.0 / 3.0)
    # integral of the straight line up to q0, and of the cube root beyond
    stored = 0.5 * first * q0 + 0.375 * (q * root - q0 * q0 ** (1.0 / 3.0))
    if y >= YIELD * y50:
        return p, 0.0, p * y50 * (stored + y / y50 - YIELD)
    return 0.5 * p * root, p * root / (6.0 * q * y50), p * y50 * stored


@inner
def clay_force(soil, s):
    """Resistance against the displacement."""
    for k in range(soil.node.shape[0]):
        y = _away(s, soil.node[k])
        if y > 0.0:
            p, _, _ = py_of_clay(soil, k, y)
            _resist(s, soil.node[k], y, p)
    return 0.0


@inner
def clay_tangent(soil, s):
    """Slope along the displacement, p / y across it."""
    for k in range(soil.node.shape[0]):
        y = _away(s, soil.node[k])
        p, slope, _ = py_of_clay(soil, k, y)
        _stiffen(s, soil.node[k], y, p, slope)
    return 0.0


@inner
def clay_energy(soil, s):
    """Work done on the springs (J)."""
    total = 0.0
    for k in range(soil.node.shape[0]):
        _, _, stored = py_of_clay(soil, k, _away(s, soil.node[k]))
        total += stored
    return total


@inner
def linear_force(soil, s):
    """Resistance against the displacement."""
    for k in range(soil.node.shape[0]):
        for c in range(len(s.dim) - 1):
            s.force[c, soil.node[k]] -= soil.stiffness[k] * s.r[c, soil.node[k]]
    return 0.0


@inner
def linear_tangent(soil, s):
    """Stiffness of the springs."""
    d = len(s.dim)
    for k in range(soil.node.shape[0]):
        for c in range(d - 1):
            s.k_node[soil.node[k], c * d + c] += soil.stiffness[k]
    return 0.0


@inner
def linear_energy(soil, s):
    """Energy of the springs (J)."""
    total = 0.0
    for k in range(soil.node.shape[0]):
        total += 0.5 * soil.stiffness[k] * _away(s, soil.node[k]) ** 2
    return total


register(
    LinearSoil, Called("soil", "soil"), device=linear_force, tangent=linear_tangent, potential=linear_energy
)
register(SoftClay, "soil", device=clay_force, tangent=clay_tangent, potential=clay_energy)
register(TabulatedSprings, "soil", device=table_force, tangent=table_tangent, potential=table_energy)
