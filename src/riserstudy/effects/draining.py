r"""Contents that drain from a disconnected riser, and sea water that follows them.

The contents move along the riser as one column, with the speed V(t) downwards. The column follows the lateral
motion of the riser, but not its axial motion. Including the wall friction, the load in the effective tension
is

.. math:: f = -m(s, t)\,g\,\hat z + m(s, t)\,\dot V\,\hat t, \qquad m = \rho_i A_i

The load f acts on the filled length of the riser, with the density :math:`\rho_i` of the fluid and the area
:math:`A_i` of the bore. Speed and level of the column come from a table (`model.mud_column`). The effects
`weight` and `contents` use the remaining mass that this effect computes. Contents that flow out carry their
kinetic energy out of the riser. The model neglects the momentum :math:`\rho A V^2` of the flow through a
curved or rotating riser, which is small compared with the tension.

References
----------
Elementary: Newton's second law for a column of fluid; Sparks (1984), as in `axial`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner
from riserstudy.solve.state import SUPPLIED, axis
from riserstudy.solve.vec import add, at, dot, mul, outer, plus, plus_block, sub, unity


class Draining(NamedTuple):
    """The column over time, the segments that it fills, and the arrays of other effects that it writes."""

    time: np.ndarray  # (k,) at equal intervals from the release on (s)
    acceleration: np.ndarray  # (k,) of the column, downwards (m/s2)
    top: np.ndarray  # (k,) level above the riser's lower end (m)
    water: np.ndarray  # (k,) level up to which sea water has entered (m)
    foot: np.ndarray  # (n,) height of each segment's lower end above the riser's lower end (m)
    bore: np.ndarray  # (n,) inner area of the segments that hold contents, else 0 (m2)
    densities: tuple[float, float]  # of contents and of sea water (kg/m3)
    gravity: float  # (m/s2)
    mass: np.ndarray  # (n,) inside each segment now (kg)
    change: np.ndarray  # (n,) its rate (kg/s)
    full: np.ndarray  # (n,) inside each at the release (kg)
    load: np.ndarray  # (n+1,) the array of `Weight` (N)
    dead: np.ndarray  # (n+1,) the same at the release (N)
    inside: np.ndarray  # (n,) the array of `AddedMass` (kg)
    minus: np.ndarray  # (n,) the same, negative (kg)
    level: float  # that of `Weight` (m)


@inner
def _now(column, s):
    """The interval of the table that contains this time, and its elapsed share; 0 before the table."""
    last = column.time.shape[0] - 1
    x = (s.clock[0] - column.time[0]) / (column.time[1] - column.time[0])
    x = min(max(x, 0.0), float(last))
    k = min(int(x), last - 1)
    return k, x - k


@inner
def _filled(column, s, e, level):
    """Length of a segment below a level (m)."""
    return min(max(level - column.foot[e], 0.0), s.l0[e])


@inner
def _held(column, s, e, top, water):
    """Mass inside a segment (kg)."""
    wet = _filled(column, s, e, water)
    contents, sea = column.densities
    return column.bore[e] * (contents * (_filled(column, s, e, top) - wet) + sea * wet)


@inner
def place(column, s):
    """Update the mass in each segment, and the load and mass of the effects that use it, to this time."""
    k, x = _now(column, s)
    span = column.time[1] - column.time[0]
    top = (1.0 - x) * column.top[k] + x * column.top[k + 1]
    water = (1.0 - x) * column.water[k] + x * column.water[k + 1]
    for i in range(column.load.shape[0]):
        column.load[i] = column.dead[i]
    for e in range(s.l0.shape[0]):
        mass = _held(column, s, e, top, water)
        before = _held(column, s, e, column.top[k], column.water[k])
        after = _held(column, s, e, column.top[k + 1], column.water[k + 1])
        column.mass[e] = mass
        column.change[e] = (after - before) / span
        column.inside[e], column.minus[e] = mass, -mass
        lost = 0.5 * column.gravity * (column.full[e] - mass)
        column.load[e] += lost
        column.load[e + 1] += lost
    return 0.0


@inner
def _thrust(column, s, e):
    """Half of the force of the column's acceleration along a segment (N)."""
    k, x = _now(column, s)
    rate = (1.0 - x) * column.acceleration[k] + x * column.acceleration[k + 1]
    return 0.5 * column.mass[e] * rate


@inner
def force(column, s):
    """Force along the riser by which the column's acceleration reduces its weight."""
    for e in range(s.l0.shape[0]):
        push = mul(_thrust(column, s, e), at(s.dim, s.tangent, e))
        plus(s.force, e, push)
        plus(s.force, e + 1, push)
    return 0.0


@inner
def tangent(column, s):
    """Derivative by the direction of the segment."""
    unit = unity(s.dim)
    for e in range(s.l0.shape[0]):
        t = at(s.dim, s.tangent, e)
        turned = mul(_thrust(column, s, e) * s.inverse_length[e], sub(unit, outer(t, t)))
        plus_block(s.k_node, e, turned)
        plus_block(s.k_low, e, turned)
        plus_block(s.k_up, e, mul(-1.0, turned))
        plus_block(s.k_node, e + 1, mul(-1.0, turned))
    return 0.0


@inner
def _across(s, i):
    """Velocity of a node across the pipe (m/s)."""
    v, t = at(s.dim, s.v, i), axis(s, 0, i)
    return sub(v, mul(dot(v, t), t))


@inner
def power(column, s):
    """Power (W) of the column's acceleration, of the decreasing weight, and of the mass that leaves."""
    up = len(s.dim) - 1
    own, other = s.share[0], s.share[1]
    for e in range(s.l0.shape[0]):
        t, low, high = at(s.dim, s.tangent, e), at(s.dim, s.v, e), at(s.dim, s.v, e + 1)
        s.flow[SUPPLIED] += _thrust(column, s, e) * dot(t, add(low, high))
        change = column.change[e]
        if change == 0.0:
            continue
        above = s.r[up, e] + s.r[up, e + 1] - 2.0 * column.level
        s.flow[SUPPLIED] += 0.5 * column.gravity * change * above
        low, high = _across(s, e), _across(s, e + 1)
        square = own * (dot(low, low) + dot(high, high)) + 2.0 * other * dot(low, high)
        s.flow[SUPPLIED] += 0.5 * change * square
    return 0.0


register(
    Draining,
    Called("draining contents", "disconnect.drain"),
    place=place,
    string=force,
    tangent=tangent,
    power=power,
)
