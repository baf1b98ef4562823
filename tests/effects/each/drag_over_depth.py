"""Drag over depth: a case, the plain version, and a string whose coefficient grows with elevation."""

from __future__ import annotations

import numpy as np
import pytest
from plain import pressed, spread
from small_scenes import simulated
from surroundings import SEGMENTS, Case, N, sheared

from riserstudy.effects.drag_over_depth import DragOverDepth

SCENE = """\
title: string in a current
water: {density: 1000 kg/m^3, surface: 100 m, seabed: 0 m}
riser:
  - name: string
    length: 100 m
    axial_stiffness: 100 GN
    submerged_weight: 0 N/m
    drag: {coefficient: [{elevation: 0 m, value: 0}, {elevation: 100 m, value: 1}], diameter: 0.5 m}
bottom: {hold: wellhead, elevation: 0 m}
top: {x: held, z: free, tension: 1 MN}
current: {profile: [{elevation: 0 m, speed: 0.5 m/s}, {elevation: 100 m, speed: 0.5 m/s}], beyond: hold}
analysis: {mesh: {elements: 20}}
"""


LOAD = 0.5 * 1000.0 * 0.5 * 0.5**2  # where the coefficient is one (N/m)


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


def test_a_string_whose_coefficient_grows_with_elevation_sags_by_a_cubic(tmp_path):
    """T x'' = -q s / L, so that x = q L^2 (s / L - (s / L)^3) / (6 T), at slopes of 1e-3."""
    found = simulated(tmp_path, SCENE)
    share = found["s"].values / 100.0
    expected = LOAD * 100.0**2 * (share - share**3) / (6.0 * 1e6)
    # a strain of 1e-5, and 20 segments
    np.testing.assert_allclose(found["x"], expected, atol=1e-4 * expected.max())


def test_a_jump_within_a_segment_leaves_force_and_lever_whole(tmp_path):
    """Loaded above 47 m alone: the support below bears q (L - 47 m)^2 / (2 L)."""
    jump = [(0, 0), (47, 0), (47, 1), (100, 1)]
    table = [{"elevation": f"{z} m", "value": c} for z, c in jump]
    found = simulated(tmp_path, SCENE, {"riser[0].drag.coefficient": table})
    below = LOAD * 53.0**2 / (2.0 * 100.0)
    slope = float(found["x"][1] / found["z"][1])
    # a strain of 1e-5
    assert slope == pytest.approx(below / 1e6, rel=3e-5)
