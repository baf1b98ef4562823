r"""The column of contents that drains from an open riser; sea water enters when the column flows back.

.. math::

   \dot Q \int_0^L \frac{\rho}{A}\,\mathrm{d}s = g \Big(\int_0^L \rho\,\mathrm{d}s - \rho_w h\Big)
       - \frac{Q|Q|}{2} \Big(\int_0^L \frac{f \rho}{D A^2}\,\mathrm{d}s + \frac{K \rho_0}{A_0^2}\Big)
       - \frac{Q^2}{2} \sum_j \rho_j \Big(\frac{1}{A_{j-}^2} - \frac{1}{A_{j+}^2}\Big)

with the volume flow Q downwards through the bore A(s) of the diameter D(s), s upwards from the lower end. Sea
water fills the riser up to L_w, and contents from there up to L. Both levels sink at the speed Q / A. The sea
surface is at the height h above the lower end. Contents leave while Q > 0 and no sea water is below them.
While Q < 0, sea water enters; it later leaves before the contents. K is the number of velocity heads lost at
the ends, with the bore A_0 at the lower end and the density of the fluid that passes there. The sum is over
the steps of the bore in the fluid, from A_j+ above to A_j- below: Bernoulli's difference of pressure. A step
loses no pressure.

References
----------
Elementary: Newton's second law for an incompressible fluid in a pipe, Bernoulli's equation, Darcy and
Weisbach's friction.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from riserstudy.errors import SimulationError
from riserstudy.records.arrays import FloatArray

SPACING = 0.02  # largest time interval of the table (s)
TOLERANCE = 1e-9  # of the integration: relative, and absolute in m and m3/s
SHORTEST = 1.0  # column length at which the computation ends (m)


class Column(NamedTuple):
    """A column at the release, in a bore of one or several parts from the lower end upwards."""

    length: float  # of the contents (m)
    depth: float  # of the sea above the lower end (m)
    bore: tuple[float, ...]  # diameter of each part (m)
    contents: float  # density (kg/m3)
    sea: float  # density (kg/m3)
    gravity: float  # (m/s2)
    friction: float  # Darcy's factor
    losses: float  # velocity heads lost at the ends
    ends: tuple[float, ...] = ()  # height of the upper end of each part but the last (m)

    @property
    def area(self) -> tuple[float, ...]:
        """Area of each part (m2)."""
        return tuple(0.25 * math.pi * diameter**2 for diameter in self.bore)


class Flow(NamedTuple):
    """The column over time, (k,) each, at equal intervals from the release on."""

    time: FloatArray  # (s)
    rate: FloatArray  # volume flow downwards (m3/s)
    speed: FloatArray  # downwards, in the narrowest part that the column fills (m/s)
    acceleration: FloatArray  # its rate (m3/s2)
    top: FloatArray  # level above the lower end (m)
    water: FloatArray  # sea water from the lower end up to here (m)


@lru_cache(maxsize=64)
def flow(column: Column, duration: float) -> Flow:
    """The column from its release on, for a duration (s).

    Raises SimulationError when all contents drain within the duration.
    """
    from scipy.integrate import solve_ivp  # loads half of scipy

    area = column.area

    def rates(_: float, y: FloatArray) -> list[float]:
        top, water, rate = y
        leaves = rate > 0.0 and water <= 0.0
        sinks = [-rate / area[bisect_left(column.ends, level)] for level in (top, water)]
        return [sinks[0], 0.0 if leaves else sinks[1], _acceleration(column, *y)]

    def runs_out(_: float, y: FloatArray) -> float:
        return float(y[0] - SHORTEST)

    runs_out.terminal = True  # type: ignore[attr-defined]
    time = np.linspace(0.0, duration, max(2, math.ceil(duration / SPACING)) + 1)
    start = [column.length, 0.0, 0.0]
    run = solve_ivp(
        rates, (0.0, duration), start, t_eval=time, events=runs_out, rtol=TOLERANCE, atol=TOLERANCE
    )
    if run.status != 0:
        raise SimulationError(
            "disconnect.drain: the run cannot continue after all contents have drained, which happens "
            f"{run.t_events[0][0]:.4g} s after the disconnect; shorten analysis.duration, or remove drain"
        )
    top, water, rate = run.y
    acceleration = np.array([_acceleration(column, *y) for y in run.y.T])
    narrowest = np.minimum.accumulate(area)[np.searchsorted(column.ends, top)]
    return Flow(time, rate, rate / narrowest, acceleration, top, np.maximum(water, 0.0))


def _acceleration(column: Column, top: float, water: float, rate: float) -> float:
    """Rate (m3/s2) of the volume flow downwards, with sea water up to ``water`` (m), contents to ``top``."""
    area, water = column.area, min(max(water, 0.0), top)
    below = (0.0, *column.ends)
    above = (*column.ends, math.inf)
    mass = inertia = friction = steps = 0.0
    for k, (low, high) in enumerate(zip(below, above, strict=True)):
        if low >= top:
            break
        wet = max(min(high, water) - low, 0.0)
        weighted = column.sea * wet + column.contents * (min(high, top) - low - wet)
        mass += weighted
        inertia += weighted / area[k]
        friction += column.friction * weighted / (column.bore[k] * area[k] ** 2)
        if k:
            density = column.sea if low < water else column.contents
            steps += density * (area[k - 1] ** -2 - area[k] ** -2)
    passing = column.contents if rate > 0.0 and water <= 0.0 else column.sea
    losses = column.losses * passing / area[0] ** 2
    driven = column.gravity * (mass - column.sea * column.depth)
    return (driven - 0.5 * (friction + losses) * rate * abs(rate) - 0.5 * steps * rate**2) / inertia
