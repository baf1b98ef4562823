"""Support: a case, the plain version, a top that a turned platform carries, and circular motion."""

from __future__ import annotations

import numpy as np
import pytest
from bodies import UPPER, bodies
from plain import carried
from surroundings import TOP, Case, N

from riserstudy import simulate
from riserstudy.effects.support import Support
from riserstudy.model.layout import AXES
from riserstudy.solve.evaluate import one_call


def support(record, s):
    """Accelerations by differences: compared apart."""
    moved = s.platform[:, :3] + carried(s.platform, record.arm)
    moved[0] += record.place - record.arm
    out = {name: getattr(s, name).copy() for name in ("r",)}
    for k, axis in enumerate(record.axis):
        if record.held[k]:
            out["r"][k, record.node] = moved[0, axis]
    return out


CASES = {
    Support: Case(
        lambda d: Support(
            N,
            np.array([1.0, -2.0, TOP]),
            np.array(AXES[d]),
            np.ones(d, np.int64),
            np.ones(d, np.int64),
            np.array([3.0, -1.0, 20.0]),
            np.zeros((3, 3)),
        )
    )
}

PLAIN = {Support: [("place", support)]}


SCENE = """\
title: string on a turned platform
riser: [{name: string, length: 100 m, axial_stiffness: 1 GN}]
bottom: {hold: wellhead, elevation: 0 m}
top: {x: platform, z: platform, elevation: 101 m}
platform:
  position: {heave: 2 m, pitch: 5 deg, yaw: 90 deg}
  centre_of_rotation: {x: -5 m, y: 0 m, elevation: 61 m}
analysis: {mesh: {elements: 4}}
"""


def test_a_platform_that_pitches_and_then_yaws_carries_the_top_along(scene_of):
    """An arm of 5 m along x and 40 m up pitches towards x, and this side then faces y."""
    found = simulate(scene_of(SCENE)).isel(s=-1)
    c, s = np.cos(np.deg2rad(5.0)), np.sin(np.deg2rad(5.0))
    place = -5.0, 5.0 * c + 40.0 * s, 61.0 + 2.0 + 40.0 * c - 5.0 * s
    np.testing.assert_allclose([found["x"], found["y"], found["z"]], place, atol=1e-9)


def circling(rate, gain):
    """A point that circles about the vertical through the origin, and that is carried along."""
    arm = np.array([3.0, -4.0, 20.0])
    follows = np.ones(3, np.int64)
    model = bodies(Support(UPPER, arm, np.arange(3), follows, follows, arm, np.zeros((3, 3))), mass=1.0)
    model.s.platform[0, [0, 5]] = 10.0, 0.7
    model.s.platform[1, [0, 5]] = 2.0, rate
    model.s.platform[2, [0, 5]] = 0.5, gain
    one_call(model.programs.value.place, model.state)
    return model.s


def test_a_point_that_circles_is_accelerated_towards_the_centre_and_along_its_way():
    """Speed w R along the circle; accelerations w^2 R inwards and w' R along it; and the platform's own."""
    rate, gain, radius = 0.3, 0.02, 5.0
    s = circling(rate, gain)
    outwards = (s.r[:, UPPER] - [10.0, 0.0, 20.0]) / radius
    assert np.linalg.norm(outwards) == pytest.approx(1.0, rel=1e-12)
    along = np.cross([0.0, 0.0, 1.0], outwards)
    np.testing.assert_allclose(s.v[:, UPPER] - [2.0, 0.0, 0.0], rate * radius * along, atol=1e-12)
    turning = gain * radius * along - rate**2 * radius * outwards
    np.testing.assert_allclose(s.a[:, UPPER] - [0.5, 0.0, 0.0], turning, atol=1e-12)
