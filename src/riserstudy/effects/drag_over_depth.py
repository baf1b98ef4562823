r"""Drag with a coefficient over elevation, evaluated at the present elevation of the moving pipe.

The coefficient C(z) is linear between the points of a table, and has a jump where two points have the same
elevation. The engine integrates the coefficient along the straight segments, weighted with the hat functions
of the nodes,

.. math:: c_{low} = 2 \int_0^1 (1 - \xi)\,C(z_\xi)\,d\xi,\qquad
          c_{up} = 2 \int_0^1 \xi\,C(z_\xi)\,d\xi,\qquad z_\xi = (1 - \xi) z_{low} + \xi z_{up},

The results are the weighted mean coefficients for the lower and the upper node of a segment. The load
therefore changes smoothly while a segment moves through a jump of the coefficient. In all other respects, the
force is equal to the force of the effect ``drag``.

References
----------
As `drag`. Elementary: a varying load integrated against linear shape functions; theory, (13a).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from riserstudy.effects.drag import force, power, press
from riserstudy.effects.drag import tangent as tangent_at_rest
from riserstudy.effects.registry import register
from riserstudy.solve.jit import inner
from riserstudy.solve.state import OTHER, OWN

LEVEL = 1e-6  # ratio of rise to length below which a segment counts as horizontal


class DragOverDepth(NamedTuple):
    """Drag of the segments whose coefficients are from one table."""

    low: np.ndarray  # (n,) rho C_D D / 2 times length (kg/m), updated as the riser moves
    up: np.ndarray  # (n,)
    force: np.ndarray  # (d, n+1) scratch: drag on the nodes (N)
    horizontal: int  # 1: the drag acts horizontally, 0: across the pipe
    scale: np.ndarray  # (n,) rho D / 2 times length (kg/m), 0 in segments without this table
    elevation: np.ndarray  # (k,) never decreasing (m)
    coefficient: np.ndarray  # (k,) C_D there; beyond the table its end values hold
    slope: np.ndarray  # (3, n) derivatives of the means, see `means`, times the scale (kg/m2)


@inner
def means(drag, s, e):
    """Means of C over a segment for its lower and upper node, and their derivatives.

    Returns c_low, c_up, and three derivatives: of c_low by z_low; of c_low by z_up, which equals that of c_up
    by z_low; and of c_up by z_up.
    """
    z, c = drag.elevation, drag.coefficient
    foot = s.r[len(s.dim) - 1, e]
    rise = s.r[len(s.dim) - 1, e + 1] - foot
    bottom, top = min(foot, foot + rise), max(foot, foot + rise)
    first = np.searchsorted(z, bottom, side="right")
    last = np.searchsorted(z, top, side="left")
    value = at_level(z, c, first, bottom)
    alike = first == last and (first == 0 or first == z.shape[0] or c[first - 1] == c[first])
    if alike or abs(rise) < LEVEL * s.l0[e]:
        return value, value, 0.0, 0.0, 0.0
    low = up = low_low = low_up = up_up = 0.0
    below, before = bottom, value
    for k in range(first, last + 1):
        above = z[k] if k < last else top
        after = c[k] if k < last else at_level(z, c, last, top)
        a, b = (below - foot) / rise, (above - foot) / rise
        m = 0.5 * (a + b)
        width, middle = abs(b - a) / 3.0, 0.5 * (before + after)  # Simpson's, twice the integral
        up += width * (a * before + 4.0 * m * middle + b * after)
        low += width * ((1.0 - a) * before + 4.0 * (1.0 - m) * middle + (1.0 - b) * after)
        # for a linear piece and for a jump: the change of C, times the mean of the weights over it
        share = (after - before) / (3.0 * abs(rise))
        up_up += share * (a * a + 4.0 * m * m + b * b)
        low_up += share * (a * (1.0 - a) + 4.0 * m * (1.0 - m) + b * (1.0 - b))
        low_low += share * ((1.0 - a) ** 2 + 4.0 * (1.0 - m) ** 2 + (1.0 - b) ** 2)
        below, before = above, after
    return low, up, low_low, low_up, up_up


@inner
def at_level(z, c, k, level):
    """C at an elevation between points k - 1 and k of the table."""
    if k == 0:
        return c[0]
    if k == z.shape[0]:
        return c[k - 1]
    return c[k - 1] + (c[k] - c[k - 1]) * (level - z[k - 1]) / (z[k] - z[k - 1])


@inner
def weigh(drag, s):
    """Update the coefficients of the segments at their present elevations, and the derivatives of these."""
    for e in range(s.l0.shape[0]):
        drag.low[e], drag.up[e] = 0.0, 0.0
        drag.slope[0, e], drag.slope[1, e], drag.slope[2, e] = 0.0, 0.0, 0.0
        if drag.scale[e] > 0.0:
            low, up, low_low, low_up, up_up = means(drag, s, e)
            drag.low[e], drag.up[e] = drag.scale[e] * low, drag.scale[e] * up
            drag.slope[0, e] = drag.scale[e] * low_low
            drag.slope[1, e] = drag.scale[e] * low_up
            drag.slope[2, e] = drag.scale[e] * up_up
    return 0.0


@inner
def tangent(drag, s):
    """Derivative of the drag, with the dependence of its coefficients on elevation."""
    tangent_at_rest(drag, s)
    press(drag, s)
    d, q = len(s.dim), s.density
    for e in range(s.l0.shape[0]):
        low_low, low_up, up_up = drag.slope[0, e], drag.slope[1, e], drag.slope[2, e]
        for k in range(d):
            c = k * d + d - 1
            low = OWN * q[k, e] + OTHER * q[k, e + 1]
            up = OWN * q[k, e + 1] + OTHER * q[k, e]
            s.k_node[e, c] -= low_low * low
            s.k_up[e, c] -= low_up * low
            s.k_low[e, c] -= low_up * up
            s.k_node[e + 1, c] -= up_up * up
    return 0.0


register(DragOverDepth, "drag", drive=weigh, string=force, tangent=tangent, power=power)
