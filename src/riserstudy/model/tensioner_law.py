"""The law of one tensioner cylinder: its pull over its reach, and the linearised law."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from riserstudy.records.arrays import FloatArray
from riserstudy.records.warning import RunWarning, warning
from riserstudy.scene.tensioners import Gas, TableRow, Tensioners, TwoChamberGas

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

ROUNDING = 1e-9  # share of the largest pull below which a negative pull is rounding


def gas_force(gas: Gas | TwoChamberGas, reach: FloatArray) -> FloatArray:
    """Gas force of one cylinder (N), in the shape of its reach from mid-stroke (m): theory (12), (12a)."""
    if isinstance(gas, TwoChamberGas):
        up, down, k = gas.high, gas.low, gas.exponent
        high = (up.volume / (up.volume - up.area * reach)) ** k
        low = (down.volume / (down.volume + down.area * reach)) ** k
        pull: FloatArray = up.area * up.pressure * high - down.area * down.pressure * low
        return pull - gas.outside_force
    ratio = gas.volume / (gas.volume - gas.area * reach)
    force: FloatArray = gas.area * gas.pressure * ratio**gas.exponent
    return force - gas.outside_force


def table_law(table: list[TableRow], interpolation: str | None = None) -> PPoly:
    """Force of one cylinder (N) over its reach (m): the interpolated table, continued linearly at its ends.

    ``interpolation``: ``linear``, else the monotone cubic.
    """
    from scipy.interpolate import PchipInterpolator, PPoly  # loaded where needed: it takes long

    reach = np.array([row.reach for row in table])
    force = np.array([row.force for row in table])
    if interpolation == "linear":
        steps = np.diff(force) / np.diff(reach)
        inner = PPoly(np.vstack([0.0 * steps, 0.0 * steps, steps, force[:-1]]), reach)
    else:
        inner = PchipInterpolator(reach, force)
    slope = inner.derivative()(reach[[0, -1]])
    room = reach[-1] - reach[0]
    straight = np.zeros((4, 2))
    straight[2] = slope
    straight[3] = float(inner(reach[0])) - slope[0] * room, float(inner(reach[-1]))
    pieces = np.hstack([straight[:, :1], inner.c, straight[:, 1:]])
    return PPoly(pieces, np.concatenate([[reach[0] - room], reach, [reach[-1] + room]]))


def leaves_table(rig: Tensioners, reach: FloatArray) -> list[RunWarning]:
    """A warning when the reach of cylinders (m), of any shape, is outside of their table."""
    if rig.table is None:
        return []
    first, last = rig.table[0].reach, rig.table[-1].reach
    if first <= reach.min() and reach.max() <= last:
        return []
    text = (
        "tensioners extend from {shortest:.4g} m to {longest:.4g} m, but their table covers only "
        "{first:g} m to {last:g} m: beyond it, force is extrapolated linearly; extend it or give stops"
    )
    values = {"shortest": reach.min(), "longest": reach.max(), "first": first, "last": last}
    return [warning("outside_tensioner_table", text, values)]


def pushes(force: FloatArray, time: FloatArray | None = None) -> list[RunWarning]:
    """A warning when cylinders push: their pull (N), (c,) at rest or (k, c) over time (k,), is negative."""
    least = float(force.min())
    if least >= -ROUNDING * float(abs(force).max()):
        return []
    push = "tensioners: a cylinder pushes, with at most {force:newtons} "
    check = ": check that its law holds there, since a cylinder on wires or with a slender rod cannot push"
    if time is None:
        return [warning("pushing_cylinder_at_rest", f"{push}in static equilibrium{check}", {"force": -least})]
    at = time[np.unravel_index(force.argmin(), force.shape)[0]]
    return [warning("pushing_cylinder", f"{push}at t = {{time:.6g}} s{check}", {"force": -least, "time": at})]


def linear_law(rig: Tensioners, gravity: float = 0.0) -> tuple[float, float]:
    """Tension at mid-stroke (N) and stiffness (N/m) of one linearised cylinder; gravity acts on pistons.

    A least-squares line is fitted to the continuous law over the stroke range.
    """
    if rig.linear:
        return rig.linear.tension, rig.linear.stiffness
    gas, made = rig.any_gas, rig.linearised
    if gas is None or made is None:
        raise TypeError("no law to make linear")
    weight = rig.piston_mass * gravity
    if made.shortest is None or made.longest is None:
        at = made.at or 0.0
        steepness = _stiffness(gas, at)
        return float(gas_force(gas, np.array([at]))[0]) - weight - steepness * at, steepness
    if made.by == "chord":
        ends = np.array([made.shortest, made.longest])
        low, high = gas_force(gas, ends) - weight
        steepness = float((high - low) / (made.longest - made.shortest))
        return float(low) - steepness * made.shortest, steepness
    node, share = np.polynomial.legendre.leggauss(64)
    middle, half = 0.5 * (made.longest + made.shortest), 0.5 * (made.longest - made.shortest)
    force = gas_force(gas, middle + half * node) - weight
    mean, slope = 0.5 * (share @ force), 1.5 * (share @ (force * node)) / half
    return float(mean - slope * middle), float(slope)


def tension_at_mid_stroke(rig: Tensioners, gravity: float = 0.0) -> float:
    """Pull of one cylinder at mid-stroke (N)."""
    if rig.table:
        return float(table_law(rig.table, rig.interpolation)(0.0))
    if rig.any_gas and not rig.linearised:
        return float(gas_force(rig.any_gas, np.zeros(1))[0]) - rig.piston_mass * gravity
    return linear_law(rig, gravity)[0]


def _stiffness(gas: Gas | TwoChamberGas, reach: float) -> float:
    """Slope of the law (N/m) at a reach from mid-stroke (m)."""
    chambers = ((gas.high, 1.0), (gas.low, -1.0)) if isinstance(gas, TwoChamberGas) else ((gas, 1.0),)
    slope = 0.0
    for c, sign in chambers:
        ratio = c.volume / (c.volume - sign * c.area * reach)
        slope += gas.exponent * c.area**2 * c.pressure / c.volume * ratio ** (gas.exponent + 1.0)
    return slope
