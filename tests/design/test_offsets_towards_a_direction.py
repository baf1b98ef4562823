"""Offsets in any direction: a turned scene has the offsets of the scene as it was."""

import copy
import math

import numpy as np
import pytest
from random_rigs import rig, written
from some_seeds import seeds

from riserstudy.design.envelope import envelope
from riserstudy.design.operability import at_offset, offset_of, offsets
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile

LIMITS = [
    {"output": "lfj_angle", "largest": "2 deg", "mode": "drilling"},
    {"output": "ufj_angle", "mean": "3 deg", "mode": "drilling"},
    {"output": "joint_stroke", "largest": "3 m", "mode": "connected"},
    {"output": "effective_tension", "smallest": "300 kN", "mode": "connected"},
]


def tree_of(seed):
    """A rig with a current, its platform at rest aside from the well."""
    draw = np.random.default_rng((seed, 77))
    tree = rig(seed, spatial=seed % 2 == 1, conductor=False)
    tree["platform"]["position"] |= {"surge": float(draw.uniform(-9.0, 9.0))}
    if seed % 2:
        tree["platform"]["position"]["sway"] = float(draw.uniform(-9.0, 9.0))
    return tree


def turned(tree, angle):
    """Platform, current and cylinders turned about the vertical through the well."""
    tree = copy.deepcopy(tree)
    c, s = math.cos(angle), math.sin(angle)
    position = tree["platform"]["position"]
    x, y = position.get("surge", 0.0), position.get("sway", 0.0)
    position |= {"surge": c * x - s * y, "sway": s * x + c * y}
    tree["current"]["heading"] = angle
    if place := tree["top"].get("tensioners", {}).get("arrangement"):
        place["first_bearing"] += angle
    return tree


def scene_of(tree):
    body = written(tree, unit_of={"heading": "rad"}) | {"limits": LIMITS}
    return SceneFile("rig.yaml", body).resolved()


@pytest.mark.parametrize("seed", seeds(8, few=2))
def test_a_turned_scene_has_the_same_offsets_in_the_turned_direction(seed):
    tree, angle = tree_of(seed), float(np.random.default_rng(seed).uniform(0.3, 6.0))
    own = offsets(scene_of(tree), 60.0, {})
    other = offsets(scene_of(turned(tree, angle)), 60.0, {}, angle)
    assert any(math.isfinite(end) for one in own for end in one[:2])
    np.testing.assert_allclose([one[:2] for one in other], [one[:2] for one in own], atol=0.02)


@pytest.mark.parametrize("seed", seeds(4, few=2))
def test_the_opposite_direction_exchanges_the_ends(seed):
    scene = scene_of(tree_of(seed))
    own, other = offsets(scene, 60.0, {}), offsets(scene, 60.0, {}, math.pi)
    np.testing.assert_allclose([(-one.high, -one.low) for one in other], [one[:2] for one in own], atol=0.02)


@pytest.mark.parametrize("seed", seeds(4, few=2))
def test_an_envelope_in_a_turned_scene_is_that_of_the_scene(seed):
    """Calm water, two currents; ends and governing limits."""
    tree, angle = tree_of(seed), 1.1
    found = []
    for one, towards in ((tree, 0.0), (turned(tree, angle), angle)):
        body = written(one, unit_of={"heading": "rad"}) | {"limits": LIMITS}
        table = envelope(SceneFile("rig.yaml", body), 60.0, [0.2, 0.6], [], 1, towards=towards).table
        found.append(table.rows)
    for own, other in zip(*found, strict=True):
        for cell, same in zip(own, other, strict=True):
            assert same == (pytest.approx(cell, abs=0.02) if isinstance(cell, float) else cell)


@pytest.mark.parametrize("seed", range(20))
def test_an_offset_moves_the_platform_along_its_direction_only(seed):
    draw = np.random.default_rng(seed)
    scene, angle, by = scene_of(tree_of(seed)), draw.uniform(-7.0, 7.0), draw.uniform(-50.0, 50.0)
    moved = at_offset(scene, by, angle)
    assert offset_of(moved, angle) == pytest.approx(by, abs=1e-9)
    across = angle + 0.5 * math.pi
    assert offset_of(moved, across) == pytest.approx(offset_of(scene, across), abs=1e-9)


@pytest.mark.parametrize("quarter, name", [(0, "surge"), (1, "sway"), (2, "surge"), (3, "sway")])
def test_right_angles_leave_the_other_axis_alone(quarter, name):
    """Rounding would make a plane riser spatial."""
    scene = scene_of(tree_of(0))
    position = at_offset(scene, 30.0, 0.5 * math.pi * quarter).platform.position
    other = {"surge": "sway", "sway": "surge"}[name]
    assert getattr(position, other) == getattr(scene.platform.position, other)


def test_a_top_that_is_held_moves_along_x_only():
    tree = tree_of(0)
    del tree["platform"]
    tree["top"] = {"x": "held", "z": "free", "tension": 3e6, "rotation": "free"}
    body = written(tree, unit_of={"heading": "rad"}) | {"limits": LIMITS[:1]}
    scene = SceneFile("rig.yaml", body).resolved()
    assert at_offset(scene, 5.0, math.pi).top.offset == -5.0
    with pytest.raises(InputError, match="along x only"):
        offsets(scene, 60.0, {}, 0.5)
