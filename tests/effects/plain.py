"""Every effect once more in plain NumPy, from its equation: what it adds to which array of the state.

A plain version takes record and state and returns the arrays that the effect's force (or drive, turn,
place, motion) must leave behind. ``pull`` laws give the pull of each cylinder.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation
from surroundings import nodes


def along(s):
    """Lengths (n,) and unit tangents (d, n) of the segments."""
    chord = np.diff(s.r, axis=1)
    length = np.sqrt((chord**2).sum(axis=0))
    return length, chord / length


def at_nodes(s):
    """Unit tangents at the nodes, (d, n+1): of the chord from neighbour to neighbour."""
    _, tangent = along(s)
    chord = s.r[:, 2:] - s.r[:, :-2]
    inner = chord / np.sqrt((chord**2).sum(axis=0))
    return np.concatenate([tangent[:, :1], inner, tangent[:, -1:]], axis=1)


def across(vector, tangent):
    return vector - (vector * tangent).sum(axis=0) * tangent


def spread(low, q, up=None):
    """Loads per length at the nodes to nodal forces: 5/12 own node, 1/12 the other."""
    out = np.zeros_like(q)
    out[:, :-1] += low * (5.0 * q[:, :-1] + q[:, 1:]) / 12.0
    out[:, 1:] += (low if up is None else up) * (5.0 * q[:, 1:] + q[:, :-1]) / 12.0
    return out


def lump(low, q, up):
    """The same with all of a node's load on itself."""
    out = np.zeros_like(q)
    out[:, :-1] += 0.5 * low * q[:, :-1]
    out[:, 1:] += 0.5 * up * q[:, 1:]
    return out


def axes(record, s):
    """Unit vectors at the nodes along which water slips past, (d, n+1)."""
    if record.horizontal:
        return np.repeat(np.eye(len(s.dim))[:, -1:], s.r.shape[1], axis=1)
    return at_nodes(s)


def axial(record, s):
    length, tangent = along(s)
    return {"force": nodes(record.stiffness * (length - s.l0) * tangent)}


def pressed(record, s, tangent=None):
    u = across(s.water - s.v, axes(record, s) if tangent is None else tangent)
    return np.sqrt((u**2).sum(axis=0)) * u


def angles(s):
    _, tangent = along(s)
    return np.unwrap(np.arctan2(tangent[0], tangent[1]))


def of_hull(record, s):
    """Axes of the hull (2, 2), one a row, its rate of turning, velocity and acceleration (2,)."""
    lateral = len(s.r) - 1
    arc, rate = (s.r[-1, -1], s.v[-1, -1]) if lateral == 2 else (0.0, 0.0)
    angle = record.heading + arc / record.radius
    axes = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    v, a = np.zeros((2, 2))
    v[:lateral], a[:lateral] = s.v[:lateral, record.node], s.a[:lateral, record.node]
    return axes, rate / record.radius, v, a


def by_angle(function, angle, h=1e-3):
    return (
        function(angle - 2 * h) - 8 * function(angle - h) + 8 * function(angle + h)
        - function(angle + 2 * h)
    ) / (12 * h)  # fmt: skip


def carried(platform, point):
    """Position, velocity, acceleration (3, 3) of a point turned with the platform, by differences."""

    def at(t):
        angles = platform[0, 3:] + t * platform[1, 3:] + 0.5 * t * t * platform[2, 3:]
        return Rotation.from_euler("xyz", angles).apply(point)

    h = 1e-3
    five = [at(k * h) for k in (-2, -1, 0, 1, 2)]
    rate = (five[0] - 8 * five[1] + 8 * five[3] - five[4]) / (12 * h)
    bend = (-five[0] + 16 * five[1] - 30 * five[2] + 16 * five[3] - five[4]) / (12 * h * h)
    return np.array([five[2], rate, bend])


def rotations(a, b):
    """Vectors of the rotations that take directions (3, k) into others."""
    across = np.cross(a, b, axis=0)
    sine = np.sqrt((across**2).sum(axis=0))
    return across * np.arctan2(sine, (a * b).sum(axis=0)) / sine
