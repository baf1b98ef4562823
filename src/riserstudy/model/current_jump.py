r"""Jumps and thin layers of a current, on a mesh that evaluates the current at its nodes only.

Drag is proportional to the square of the speed, and each node represents a length of riser. A layer of
current that is thinner than a segment can lie between two nodes, which then do not see it. Near such a layer,
and near a jump, the current is therefore replaced by a current whose load is a mean. The mean is taken over
the segments on both sides of a node, of lengths a below and b above, with the hat function of the node,

.. math:: |\bar u|\,\bar u = \frac{2}{a+b}\int_{z-a}^{z+b} |u|\,u\;\varphi(\zeta)\,d\zeta ,

which is one at the node and zero at both neighbours. The lumping of drag spreads a part of each node's load
to its neighbours. The current is chosen so that the load of a node is the mean after this spreading; close to
a strong jump it can therefore flow backwards, by up to 0.3 times the jump. The total load on an upright riser
is then exact on any mesh, and so is its moment if the segments are equal. No load jumps when a node moves.

References
----------
None: the project's own, with its error above.
"""

from __future__ import annotations

import numpy as np

from riserstudy.records.arrays import FloatArray
from riserstudy.solve.state import OTHER, OWN

# deviation of the speed from a straight line over two segments, as a share of the largest speed, from which
# on a mean replaces the profile
BENT = 0.1
PARTS = 16  # points of the replaced profile in a segment
WINDOW = 3.0  # distance from a layer, in segments, up to which a mean replaces the profile
SPREAD = OTHER / (OWN + OTHER)  # share of a node's load that lumping gives to its neighbours
TINY = 1e-300  # (m) avoids a division by zero at the ends of the riser
# three Gauss points of an interval and their weights: exact for the moment of a load that is quadratic
GAUSS = ((0.5 - 0.5 * 0.6**0.5, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + 0.5 * 0.6**0.5, 5.0 / 18.0))


def spread(z: FloatArray, velocity: FloatArray, nodes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A table of a current that a mesh can evaluate at its nodes.

    Parameters
    ----------
    z : (k,) elevations (m), rising, twice at a jump.
    velocity : (parts, k) along one direction, or along x and y (m/s).
    nodes : (n + 1,) elevations of the nodes of an upright riser (m), rising.

    Returns
    -------
    z, velocity : the table, with means near jumps and thin layers, and unchanged elsewhere.
    """
    table, windows = (z, velocity), _windows(z, velocity, nodes)
    for low, high in windows:
        levels = _levels(low, high, nodes)
        mean = _of_load(_sharpened(*table, levels, nodes))
        mean[:, [0, -1]] = _at(*table, levels[[0, -1]])  # continues the rest of the table
        below, above = z < low, z > high
        velocity = np.concatenate([velocity[:, below], mean, velocity[:, above]], axis=1)
        z = np.concatenate([z[below], levels, z[above]])
    return z, velocity


def up_to_surface(z: FloatArray, velocity: FloatArray, surface: float) -> tuple[FloatArray, FloatArray]:
    """The table up to the still-water surface (m); above it, the velocity at the surface applies.

    The loads of a segment that crosses the surface are multiplied by its wet share. A jump of the current at
    the surface, spread over this segment, would reduce these loads a second time. ``z``: (k,) elevations (m),
    rising; ``velocity``: (parts, k) (m/s).
    """
    below = int(np.searchsorted(z, surface))
    if below == len(z):
        return z, velocity
    if below == 0:
        return z[:1], velocity[:, :1]
    share = (surface - z[below - 1]) / (z[below] - z[below - 1])
    there = (1.0 - share) * velocity[:, below - 1] + share * velocity[:, below]
    return np.append(z[:below], surface), np.column_stack([velocity[:, :below], there])


def _windows(z: FloatArray, velocity: FloatArray, nodes: FloatArray) -> list[tuple[float, float]]:
    """Separate ranges of elevation (m) around jumps and thin layers."""
    reach = np.max(_reach(z, nodes), axis=0)
    there = 0.5 * (_at(z, velocity, z - reach) + _at(z, velocity, z + reach))
    bent = np.linalg.norm(velocity - there, axis=0) > BENT * np.linalg.norm(velocity, axis=0).max()
    bent[:-1] |= np.diff(z) == 0.0
    found: list[tuple[float, float]] = []
    for k in np.flatnonzero(bent):
        low, high = z[k] - WINDOW * reach[k], z[k] + WINDOW * reach[k]
        if found and low <= found[-1][1]:
            low, high = min(low, found[-1][0]), max(high, found.pop()[1])
        found.append((float(low), float(high)))
    return found


def _reach(z: FloatArray, nodes: FloatArray) -> FloatArray:
    """Distances (m) from a node at an elevation (m) to the nodes below and above, (2, k)."""
    size = np.diff(nodes)
    return np.array([np.interp(z, nodes, a) for a in (np.append(0.0, size), np.append(size, 0.0))])


def _levels(low: float, high: float, nodes: FloatArray) -> FloatArray:
    """Elevations of a window (m) at which means are computed, also beyond the ends of the riser."""
    n = len(nodes) - 1
    inside = np.interp(np.arange(PARTS * n + 1) / PARTS, np.arange(n + 1), nodes)
    ends = (nodes[1] - nodes[0], nodes[-1] - nodes[-2])
    below = np.arange(low, min(high, nodes[0]), ends[0] / PARTS)
    above = np.arange(high, max(low, nodes[-1]), -ends[1] / PARTS)
    levels = np.unique(np.concatenate([[low], below, inside, above, [high]]))
    return np.asarray(levels[(levels >= low) & (levels <= high)])


def _sharpened(z: FloatArray, velocity: FloatArray, levels: FloatArray, nodes: FloatArray) -> FloatArray:
    """Load ((m/s)^2) at elevations (m) whose lumped distribution is the mean load of each node."""
    below, above = _reach(levels, nodes)
    parts = np.split(np.concatenate([levels - below, levels, levels + above]), 3)
    low, here, high = (_mean_load(z, velocity, part, nodes) for part in parts)
    return np.asarray(here - SPREAD * (below * (low - here) + above * (high - here)) / (below + above))


def _mean_load(z: FloatArray, velocity: FloatArray, levels: FloatArray, nodes: FloatArray) -> FloatArray:
    """Mean of speed times velocity ((m/s)^2) at elevations (m), with the hat function of a node there.

    With F, the load integrated twice, the integral of the load times the hat function is the mean slope of F
    above the node minus its mean slope below. At an end, the hat function has one side only.
    """
    below, above = _reach(levels, nodes)
    low, high = levels - below, levels + above
    marks = np.unique(np.concatenate([z, low, levels, high]))
    once, twice = _integrals(z, velocity, marks)
    f_low, f_here, f_high = (twice[:, np.searchsorted(marks, place)] for place in (low, levels, high))
    slope = once[:, np.searchsorted(marks, levels)]
    up = np.where(high > levels, (f_high - f_here) / np.maximum(high - levels, TINY), slope)
    down = np.where(levels > low, (f_here - f_low) / np.maximum(levels - low, TINY), slope)
    return np.asarray(2.0 * (up - down) / (high - low))


def _integrals(z: FloatArray, velocity: FloatArray, marks: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Integral of the load, and its integral, from the first of rising elevations (m) on, (parts, marks)."""
    step = np.diff(marks)
    once, twice = np.zeros((2, len(velocity), len(marks)))
    for place, weight in GAUSS:
        load = weight * step * _load(_at(z, velocity, marks[:-1] + place * step))
        once[:, 1:] += load
        twice[:, 1:] += (1.0 - place) * step * load
    once = np.cumsum(once, axis=1)
    twice[:, 1:] += once[:, :-1] * step
    return once, np.cumsum(twice, axis=1)


def _at(z: FloatArray, velocity: FloatArray, levels: FloatArray) -> FloatArray:
    """Velocity of the table at elevations (m), (parts, levels), m/s; its end values hold beyond."""
    return np.array([np.interp(levels, z, part) for part in velocity])


def _load(velocity: FloatArray) -> FloatArray:
    """Speed times velocity, to which drag is proportional ((m/s)^2)."""
    return np.asarray(np.linalg.norm(velocity, axis=0) * velocity)


def _of_load(load: FloatArray) -> FloatArray:
    """The velocity (m/s) of a load ((m/s)^2)."""
    root = np.sqrt(np.linalg.norm(load, axis=0))
    return np.asarray(load / np.where(root > 0.0, root, 1.0))
