"""Fatigue damage does not depend on how a scene is written."""

import math

import numpy as np
import pytest
from changes import lifted, mirrored, rotated, split, swayed_by_nothing
from fatigued_rigs import INSIDE, WELD, fatigued
from random_rigs import moving, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def damage_of(tree):
    return run(SceneFile("rig.yaml", tree).resolved(), estimated=False).arrays["damage_rate"]


class Turned:
    """In place of a generator: turns by an angle."""

    def __init__(self, angle):
        self.angle = angle

    def uniform(self, *_):
        return self.angle


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("way", [rotated, mirrored, lifted, split, swayed_by_nothing])
def test_a_scene_written_otherwise_has_the_same_damage(seed, way):
    """Turned by an eighth of a turn damage is turned, too; in a plane and in space it is the same."""
    tree = fatigued(moving(seed), WELD, INSIDE)
    turned = {rotated: 1, mirrored: 4}.get(way, 0)
    other = way(tree, Turned(math.pi / 4.0) if way is rotated else np.random.default_rng(seed))
    if way is rotated and tree["platform"].get("pitch"):
        turned = 0  # which it leaves as it is
    plain = damage_of(written(tree))
    found = damage_of(other.tree)
    found = np.roll(found, -turned, axis=1)
    assert found.shape == plain.shape
    most = np.nanmax(plain, axis=(1, 2), keepdims=True)
    assert np.nanmax(np.abs(found - plain) / most) < 1e-3
