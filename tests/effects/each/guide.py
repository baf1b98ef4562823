"""Guide: a case, the plain version, and a string pushed against one."""

from __future__ import annotations

import numpy as np
import pytest
from surroundings import Case

from riserstudy import simulate
from riserstudy.effects.guide import Guide
from riserstudy.errors import InputError
from riserstudy.model.build import build
from riserstudy.model.mesh import even

SCENE = """\
title: guided string
riser:
  - {name: below, length: 60 m, axial_stiffness: 100 GN}
  - {name: above, length: 40 m, axial_stiffness: 100 GN, guide_below: {stiffness: 2 kN/m}}
bottom: {hold: wellhead, elevation: 0 m}
top: {x: held, z: free, tension: 500 kN, offset: 0.5 m}
analysis: {mesh: {elements: 10}}
"""


def guide(record, s):
    out = np.zeros_like(s.force)
    out[:-1, record.node] = -record.stiffness * s.r[:-1, record.node]
    return {"force": out}


CASES = {Guide: Case(lambda d: Guide(3, 2e5), directions=(2, 3))}

PLAIN = {Guide: [("device", guide)]}


def test_a_string_bends_at_its_guide_alone(scene_of):
    """T (u / 60 + (u - 0.5) / 40) + k u = 0 where slopes are small: straight below and above."""
    found = simulate(scene_of(SCENE))
    tension, k = 500e3, 2e3
    u = tension * 0.5 / 40.0 / (tension / 60.0 + tension / 40.0 + k)
    x = found["x"].interp(s=[30.0, 60.0, 80.0])  # all three are nodes
    # slopes of 0.01: their squares, 1e-4
    np.testing.assert_allclose(x, [u / 2.0, u, (u + 0.5) / 2.0], rtol=2e-4)


@pytest.mark.parametrize("offset, there", [(", offset: 0.5 m", True), ("", False)])
def test_a_guide_is_there_where_something_moves_aside(scene_of, offset, there):
    scene = scene_of(SCENE.replace(", offset: 0.5 m", offset)).resolved()
    assert ("guide" in [effect.name for effect in build(scene, even(scene, 10)).effects]) == there


def test_a_guide_at_a_held_end_is_refused(scene_of):
    with pytest.raises(InputError, match="give it to a section above"):
        scene_of(SCENE.replace("length: 60 m,", "length: 60 m, guide_below: {stiffness: 2 kN/m},")).resolved()
