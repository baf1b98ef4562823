"""Waterline: a case, the plain version, and the draught of a pipe that leaves the water.

tests/verification/test_waterline.py compares a string through the surface with its closed form.
"""

from __future__ import annotations

import numpy as np
import pytest
from surroundings import L0, Case, N, sea

from riserstudy.effects.current import Current
from riserstudy.effects.drag import Drag
from riserstudy.effects.waterline import Waterline
from riserstudy.effects.wave import CONSTANT
from riserstudy.model.model import Effect, Model, Unknowns
from riserstudy.solve.evaluate import forces_and_tangent


def waterline(record, s):
    """Nodes with dry segments alone see no water; shares are tested with the waterline."""
    dry = record.surface + s.level < s.r[-1]
    alone = dry & np.append(True, dry[:-1]) & np.append(dry[1:], True)
    return {name: np.where(alone, 0.0, getattr(s, name)) for name in ("water", "water_rate")}


CASES = {
    Waterline: Case(
        lambda d: Waterline(45.0, np.ones((3, N)), np.ones(N), *np.ones((4, N))),
        lambda d: [sea(d, CONSTANT)] if d > 1 else [],
    )
}

PLAIN = {Waterline: [("drive", waterline)]}


DRAG, ADDED, CARRIED, SPEED = 500.0, 300.0, 700.0, 0.8  # kg/m2, kg/m, kg/m, m/s


@pytest.mark.parametrize("lean", [0.0, 0.6])
@pytest.mark.parametrize("surface", [-4.0, 0.0, 17.3, 21.0, 50.0, 1e3])
def test_a_straight_pipe_is_loaded_along_its_wet_length(surface, lean):
    """In a uniform current the drag is that of the wet length; so are added mass and the mass of waves."""
    low = DRAG * L0
    drag, added, minus, carried = low.copy(), ADDED * L0, -ADDED * L0, CARRIED * L0
    line = Waterline(surface, np.array([low, added, carried]), np.ones(N), drag, added, minus, carried)
    near = np.zeros(N + 1, np.int64)
    records = [
        Current(np.array([0.0, 1.0]), np.full(2, SPEED), np.ones(1), near, 0.0),
        line,
        Drag(drag, drag, np.zeros((2, N + 1)), 0),
    ]
    model = Model(Unknowns(L0, 2, 0), [Effect(type(r).__name__, r, "") for r in records])
    place = np.append(0.0, np.cumsum(L0))
    model.s.r[:] = np.outer([np.sin(lean), np.cos(lean)], place)
    model.s.clock[:] = 1.0
    forces_and_tangent(model.programs, model.state)
    wet = np.clip(surface / np.cos(lean), 0.0, L0.sum())
    across = SPEED * np.cos(lean)
    pressed = DRAG * wet * across**2
    # a segment that is partly wet loads both its nodes alike, so the sum is that of its wet share
    np.testing.assert_allclose(model.s.force.sum(axis=1), pressed * np.array([np.cos(lean), -np.sin(lean)]),
                               atol=1e-9 * DRAG * L0.sum())  # fmt: skip
    assert added.sum() == pytest.approx(ADDED * wet, abs=1e-9)
    assert minus.sum() == pytest.approx(-ADDED * wet, abs=1e-9)
    assert carried.sum() == pytest.approx(CARRIED * wet, abs=1e-9)
