r"""Exchange of force and motion between platform and riser, if the two are solved in turn.

The platform receives the force of the riser, interpolated linearly between the times of a table. The top
of the riser receives the motion of the platform, by the cubic through positions and velocities at the
times of a table,

.. math::

   r = r_0 + x\,\Delta + x (1 - x) \big[(1 - x)(h v_0 - \Delta) + x (\Delta - h v_1)\big],\qquad
   \Delta = r_1 - r_0,

Here h is the time between two rows of the table, and x is the fraction of h that has elapsed. The indices 0
and 1 denote the two rows. The velocity is the derivative of r. The acceleration is interpolated linearly, and
is therefore equal to the acceleration of the platform at each time of the table.

References
----------
Elementary: cubic Hermite interpolation. Theory, (15a), gives the energy error of the exchange.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import register
from riserstudy.solve.jit import inner
from riserstudy.solve.state import SUPPLIED


class ForceTable(NamedTuple):
    """Force on a node over time, in its first directions; reports the motion of the node."""

    node: int
    time: np.ndarray  # (k,) rising (s)
    load: np.ndarray  # (k, c) (N)
    probe: int  # first of its probes: velocity (m/s) and acceleration (m/s2) of each direction


class MotionTable(NamedTuple):
    """Motion of a node over time, in its first directions."""

    node: int
    time: np.ndarray  # (k,) rising (s)
    path: np.ndarray  # (3, k, c) position (m), velocity (m/s), acceleration (m/s2)


@inner
def _piece(time, now):
    """Interval of a table that contains a time, its length, and its elapsed share."""
    last = time.shape[0] - 1
    inside = min(max(now, time[0]), time[last])
    k = min(max(np.searchsorted(time, inside, side="right") - 1, 0), last - 1)
    h = time[k + 1] - time[k]
    return k, h, (inside - time[k]) / h


@inner
def force(table, s):
    """The load at this time."""
    k, _, x = _piece(table.time, s.clock[0])
    for c in range(table.load.shape[1]):
        s.force[c, table.node] += (1.0 - x) * table.load[k, c] + x * table.load[k + 1, c]
    return 0.0


@inner
def power(table, s):
    """Power that it supplies (W)."""
    k, _, x = _piece(table.time, s.clock[0])
    for c in range(table.load.shape[1]):
        load = (1.0 - x) * table.load[k, c] + x * table.load[k + 1, c]
        s.flow[SUPPLIED] += load * s.v[c, table.node]
    return 0.0


@inner
def probe(table, s):
    """Report velocity and acceleration of the node."""
    for c in range(table.load.shape[1]):
        s.probe[table.probe + 2 * c] = s.v[c, table.node]
        s.probe[table.probe + 2 * c + 1] = s.a[c, table.node]
    return 0.0


@inner
def place(table, s):
    """Set position, velocity and acceleration of the node to those of the table."""
    k, h, x = _piece(table.time, s.clock[0])
    path, i = table.path, table.node
    for c in range(path.shape[2]):
        d = path[0, k + 1, c] - path[0, k, c]
        slope, twist = h * path[1, k, c] - d, d - h * path[1, k + 1, c]
        bump = slope * (1.0 - x) + twist * x
        s.r[c, i] = path[0, k, c] + x * d + x * (1.0 - x) * bump
        s.v[c, i] = (d + (1.0 - 2.0 * x) * bump + x * (1.0 - x) * (twist - slope)) / h
        s.a[c, i] = (1.0 - x) * path[2, k, c] + x * path[2, k + 1, c]
    return 0.0


register(ForceTable, device=force, power=power, probe=probe)
register(MotionTable, place=place)
