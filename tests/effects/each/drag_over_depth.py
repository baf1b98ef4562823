"""Drag over depth: a case, and the plain version."""

from __future__ import annotations

import numpy as np
from plain import pressed, spread
from surroundings import SEGMENTS, Case, N, sheared

from riserstudy.effects.drag_over_depth import DragOverDepth


def depths(d: int) -> DragOverDepth:
    """Below the table, on a slope of it with a corner, across two jumps in one segment, and above it."""
    return DragOverDepth(
        *np.zeros((2, N)), np.zeros((d, N + 1)), 0, 6e3 * np.append(SEGMENTS[:-1], 0.0),
        np.array([4.0, 20.0, 22.0, 29.0, 29.0, 31.0, 31.0, 41.0]),
        np.array([0.9, 1.5, 0.6, 0.8, 1.3, 1.2, 0.5, 0.7]), np.zeros((3, N)),
    )  # fmt: skip


def drag_over_depth(record, s):
    """Coefficients by many points in each segment, instead of piece by piece."""
    share = (np.arange(100_000) + 0.5) / 100_000
    low, up = np.zeros((2, len(s.l0)))
    for e, scale in enumerate(record.scale):
        z = s.r[-1, e] + share * (s.r[-1, e + 1] - s.r[-1, e])
        # a jump is a slope over a micrometre
        at = record.elevation + 1e-6 * np.append(0.0, np.diff(record.elevation) == 0.0)
        c = scale * np.interp(z, at, record.coefficient)
        low[e], up[e] = 2.0 * ((1.0 - share) * c).mean(), 2.0 * (share * c).mean()
    return {"force": spread(low, pressed(record, s), up)}


CASES = {DragOverDepth: Case(depths, lambda d: [sheared(d)])}

PLAIN = {DragOverDepth: [("drive string", drag_over_depth)]}
