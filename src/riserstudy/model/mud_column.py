r"""The column of contents that drains from an open riser; sea water enters when the column flows back.

.. math::

   (\rho_m L_m + \rho_w L_w)\,\dot V = g\,(\rho_m L_m + \rho_w L_w - \rho_w h)
       - \Big(f\,\frac{\rho_m L_m + \rho_w L_w}{D} + K \rho\Big) \frac{V|V|}{2},\qquad \dot L = -V

with V downwards and L = L_m + L_w: contents of the height L_m above sea water of the height L_w. The sea
surface is at the height h above the lower end. Contents leave while V > 0 and no sea water is below them.
While V < 0, sea water enters; it later leaves before the contents. K is the number of velocity heads lost at
the ends, with the density of the fluid that passes there.

References
----------
Elementary: Newton's second law for a rigid column, Darcy and Weisbach's friction.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from riserstudy.errors import SimulationError
from riserstudy.records.arrays import FloatArray

SPACING = 0.02  # largest time interval of the table (s)
TOLERANCE = 1e-9  # of the integration: relative, and absolute in m and m/s
SHORTEST = 1.0  # column length at which the computation ends (m)


class Column(NamedTuple):
    """A column at the release."""

    length: float  # of the contents (m)
    depth: float  # of the sea above the lower end (m)
    bore: float  # diameter (m)
    contents: float  # density (kg/m3)
    sea: float  # density (kg/m3)
    gravity: float  # (m/s2)
    friction: float  # Darcy's factor
    losses: float  # velocity heads lost at the ends


class Flow(NamedTuple):
    """The column over time, (k,) each, at equal intervals from the release on."""

    time: FloatArray  # (s)
    speed: FloatArray  # downwards (m/s)
    acceleration: FloatArray  # downwards (m/s2)
    top: FloatArray  # level above the lower end (m)
    water: FloatArray  # sea water from the lower end up to here (m)


@lru_cache(maxsize=64)
def flow(column: Column, duration: float) -> Flow:
    """The column from its release on, for a duration (s).

    Raises SimulationError when all contents drain within the duration.
    """
    from scipy.integrate import solve_ivp  # loads half of scipy

    def rates(_: float, y: FloatArray) -> list[float]:
        total, contents, speed = y
        leaves = speed > 0.0 and contents >= total
        return [-speed, -speed if leaves else 0.0, _acceleration(column, *y)]

    def runs_out(_: float, y: FloatArray) -> float:
        return float(y[0] - SHORTEST)

    runs_out.terminal = True  # type: ignore[attr-defined]
    time = np.linspace(0.0, duration, max(2, math.ceil(duration / SPACING)) + 1)
    start = [column.length, column.length, 0.0]
    run = solve_ivp(
        rates, (0.0, duration), start, t_eval=time, events=runs_out, rtol=TOLERANCE, atol=TOLERANCE
    )
    if run.status != 0:
        raise SimulationError(
            "disconnect.drain: the run cannot continue after all contents have drained, which happens "
            f"{run.t_events[0][0]:.4g} s after the disconnect; shorten analysis.duration, or remove drain"
        )
    total, contents, speed = run.y
    acceleration = np.array([_acceleration(column, *y) for y in run.y.T])
    return Flow(time, speed, acceleration, total, np.maximum(total - contents, 0.0))


def _acceleration(column: Column, total: float, contents: float, speed: float) -> float:
    """Acceleration downwards (m/s2) of a column of length ``total`` (m), with ``contents`` (m) of mud."""
    contents = min(contents, total)
    mass = column.contents * contents + column.sea * (total - contents)
    passing = column.contents if speed > 0.0 and contents >= total else column.sea
    drag = column.friction * mass / column.bore + column.losses * passing
    driven = column.gravity * (mass - column.sea * column.depth)
    return (driven - 0.5 * drag * speed * abs(speed)) / mass
