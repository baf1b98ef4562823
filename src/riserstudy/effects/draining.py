r"""Contents that drain from a disconnected riser, and sea water that follows them.

The contents move along the riser as one column, with the volume flow Q(t) downwards. The column follows the
lateral motion of the riser, but not its axial motion. Including the wall friction, the load in the effective
tension is

.. math:: f = -m(s, t)\,g\,\hat z + \rho_i\,\dot Q\,\hat t, \qquad m = \rho_i A_i

The load f acts on the filled length of the riser, with the density :math:`\rho_i` of the fluid and the area
:math:`A_i` of the bore. Where the bore changes from :math:`A_+` above to :math:`A_-` below, the flow changes
its momentum, and pulls with

.. math:: F = \rho_i Q^2 (1/A_- - 1/A_+)\,\hat t

Flow and level of the column come from a table (`model.mud_column`). The effects `weight` and `contents` use
the remaining mass that this effect computes. Contents that flow out carry their kinetic energy out of the
riser. The model neglects the momentum :math:`\rho Q^2 / A` of the flow through a curved or rotating riser,
which is small compared with the tension.

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
from riserstudy.solve.vec import at, dot, mul, outer, plus, plus_block, sub, unity


class Draining(NamedTuple):
    """The column over time, the segments that it fills, and the arrays of other effects that it writes."""

    time: np.ndarray  # (k,) at equal intervals from the release on (s)
    acceleration: np.ndarray  # (k,) rate of the volume flow downwards (m3/s2)
    square: np.ndarray  # (k,) square of the volume flow (m6/s2)
    top: np.ndarray  # (k,) level above the riser's lower end (m)
    water: np.ndarray  # (k,) level up to which sea water has entered (m)
    foot: np.ndarray  # (n,) height of each segment's lower end above the riser's lower end (m)
    bore: np.ndarray  # (n,) inner area of the segments that hold contents, else 0 (m2)
    steps: np.ndarray  # (n+1,) where the bore changes: 1/area below minus 1/area above (1/m2), else 0
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
def _levels(column, k, x):
    """Level of the fluid, and of the sea water below the contents (m)."""
    top = (1.0 - x) * column.top[k] + x * column.top[k + 1]
    water = (1.0 - x) * column.water[k] + x * column.water[k + 1]
    return top, water


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
    top, water = _levels(column, k, x)
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
    """Force along a segment (N, 2 values): on its lower and on its upper end."""
    k, x = _now(column, s)
    rate = (1.0 - x) * column.acceleration[k] + x * column.acceleration[k + 1]
    half = 0.5 * column.mass[e] / column.bore[e] * rate if column.bore[e] > 0.0 else 0.0
    return half + _turning(column, e, k, x), half + _turning(column, e + 1, k, x)


@inner
def _turning(column, i, k, x):
    """Half of the force of the flow at a step of the bore (N)."""
    if column.steps[i] == 0.0:
        return 0.0
    square = (1.0 - x) * column.square[k] + x * column.square[k + 1]
    top, water = _levels(column, k, x)
    contents, sea = column.densities
    height = column.foot[i]
    density = sea if height < water else contents if height < top else 0.0
    return 0.5 * density * square * column.steps[i]


@inner
def force(column, s):
    """Force along the riser by which the column's acceleration and its changes of speed reduce its weight."""
    for e in range(s.l0.shape[0]):
        low, high = _thrust(column, s, e)
        t = at(s.dim, s.tangent, e)
        plus(s.force, e, mul(low, t))
        plus(s.force, e + 1, mul(high, t))
    return 0.0


@inner
def tangent(column, s):
    """Derivative by the direction of the segment."""
    unit = unity(s.dim)
    for e in range(s.l0.shape[0]):
        low, high = _thrust(column, s, e)
        t = at(s.dim, s.tangent, e)
        turned = mul(s.inverse_length[e], sub(unit, outer(t, t)))
        plus_block(s.k_node, e, mul(low, turned))
        plus_block(s.k_low, e, mul(high, turned))
        plus_block(s.k_up, e, mul(-low, turned))
        plus_block(s.k_node, e + 1, mul(-high, turned))
    return 0.0


@inner
def _across(s, i):
    """Velocity of a node across the pipe (m/s)."""
    v, t = at(s.dim, s.v, i), axis(s, 0, i)
    return sub(v, mul(dot(v, t), t))


@inner
def power(column, s):
    """Power (W) of the force along the riser, of the decreasing weight, and of the mass that leaves."""
    up = len(s.dim) - 1
    own, other = s.share[0], s.share[1]
    for e in range(s.l0.shape[0]):
        t, thrust = at(s.dim, s.tangent, e), _thrust(column, s, e)
        s.flow[SUPPLIED] += thrust[0] * dot(t, at(s.dim, s.v, e)) + thrust[1] * dot(t, at(s.dim, s.v, e + 1))
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
