"""Tangential drag: a case, the plain version, and a pipe that glides along itself.

tests/verification/test_consistency_of_tangential_drag.py compares a heaving riser with its equations.
"""

from __future__ import annotations

import numpy as np
import pytest
from bodies import LOWER, UPPER, bodies, energy, motion
from plain import along
from surroundings import SEGMENTS, Case, sheared

from riserstudy.effects.tangential_drag import TangentialDrag


def tangential_drag(record, s):
    _, tangent = along(s)
    slip = s.water - s.v
    u = (0.5 * (slip[:, :-1] + slip[:, 1:]) * tangent).sum(axis=0)
    half, out = 0.5 * record.low * np.abs(u) * u * tangent, np.zeros_like(s.force)
    out[:, :-1] += half
    out[:, 1:] += half
    return {"force": out}


CASES = {
    TangentialDrag: Case(lambda d: TangentialDrag(2e4 * SEGMENTS), lambda d: [sheared(d)] if d > 1 else [])
}

PLAIN = {TangentialDrag: [("string", tangential_drag)]}

# without a load, in a plane on n segments
UNLOADED = {"tangential drag": lambda n: TangentialDrag(np.zeros(n))}


@pytest.mark.parametrize("axis", [(0.0, 0.0, 1.0), (0.48, 0.64, 0.6)])
def test_a_pipe_that_glides_along_itself_slows_down_as_one_over_time(axis):
    """x = M / c log(1 + c v t / M); nothing pushes it aside, and the water has the energy it lost."""
    mass, drag, speed = 4e3, 2e3, 3.0
    model = bodies(TangentialDrag(np.array([drag])), mass=0.5 * mass, free=(LOWER, UPPER))
    model.s.r[:, UPPER] = axis
    model.s.v[:, LOWER] = model.s.v[:, UPPER] = speed * np.array(axis)
    before = energy(model)
    found = motion(model, 5.0, 2000)
    way = mass / drag * np.log1p(drag * speed * found.time / mass)
    for node in (LOWER, UPPER):
        moved = found.place[..., node] - found.place[0, :, node]
        np.testing.assert_allclose(moved, np.outer(way, axis), atol=1e-5 * way.max())
    assert found.dissipated == pytest.approx(before - energy(model), rel=1e-5)


def test_water_that_flows_across_a_pipe_does_not_pull_it_along():
    model = bodies(TangentialDrag(np.array([2e3])), mass=2e3, free=(LOWER, UPPER))
    model.s.v[:2] = [[1.0], [2.0]]
    found = motion(model, 1.0, 10)
    moved = found.place[-1] - found.place[0]
    np.testing.assert_allclose(moved, [[1.0] * 2, [2.0] * 2, [0.0] * 2], atol=1e-12)
