r"""Water surface: drag, added mass and wave force act only on the part of a segment in the water.

.. math:: w_e = \frac{d_+}{d_+ - d_-}

The formula gives the wet share :math:`w_e` of a segment with one end under water, at the depth :math:`d_+`
below the surface, and the other end above the surface, at the negative depth :math:`d_-`. The wet share of
all other segments is 1 or 0. Between nodes, the elevation of the surface is interpolated linearly. The engine
computes the loads of the segment as if the whole segment were under water, and multiplies the loads by the
wet share. At the end above the surface, the water velocity is the velocity at the surface. The error of the
loads is of second order in the segment length, and the loads do not jump when a node emerges or submerges.

The submerged weight of a segment is the value of the scene, and does not change. The force due to the
changing added mass (slamming) is neglected.

References
----------
None: the method is the project's own; its error is given above.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.registry import Called, register
from riserstudy.solve.jit import inner

DRAG, ADDED, CARRIED = 0, 1, 2  # rows of the full coefficients


class Waterline(NamedTuple):
    """Coefficients of fully wet segments, and the present coefficients, which other effects read."""

    surface: float  # elevation of the mean level (m)
    full: np.ndarray  # (3, n) drag (kg/m), added mass, mass that waves accelerate (kg)
    wet: np.ndarray  # (n,) wet share of each segment that the present coefficients have
    # (n,) the array of `Drag` or `TangentialDrag`, or the scale of `DragOverDepth`, which is evaluated later
    drag: np.ndarray
    added: np.ndarray  # (n,) the array of `AddedMass` (kg)
    minus: np.ndarray  # (n,) the same, negative (kg)
    carried: np.ndarray  # (n,) the array of `WaveForce` (kg)


@inner
def _share(low, up):
    """Share of a segment under water, from the depths of its ends."""
    if low >= 0.0 and up >= 0.0:
        return 1.0
    if low <= 0.0 and up <= 0.0:
        return 0.0
    return max(low, up) / abs(low - up)


@inner
def drive(line, s):
    """Update the wet share of every segment; no water motion at nodes above the surface in dry segments."""
    top, n = len(s.dim) - 1, s.l0.shape[0]
    low = line.surface + s.level[0] - s.r[top, 0]
    before = 0.0
    for e in range(n):
        up = line.surface + s.level[e + 1] - s.r[top, e + 1]
        share = _share(low, up)
        if share != line.wet[e]:
            line.wet[e] = share
            line.drag[e] = share * line.full[DRAG, e]
            line.added[e] = share * line.full[ADDED, e]
            line.minus[e] = -line.added[e]
            line.carried[e] = share * line.full[CARRIED, e]
        if low < 0.0 and before == 0.0 and share == 0.0:
            _dry(s, e)
        low, before = up, share
    if low < 0.0 and before == 0.0:
        _dry(s, n)
    return 0.0


@inner
def _dry(s, i):
    for k in range(len(s.dim)):
        s.water[k, i], s.shear[k, i], s.water_rate[k, i] = 0.0, 0.0, 0.0


register(
    Waterline,
    Called("waterline", "water.surface, and riser.drag, tangential_drag or added_mass"),
    drive=drive,
)
