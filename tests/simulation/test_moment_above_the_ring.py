"""Moments and shear in a telescopic joint, where tensioners pull unequally and the moment jumps at the ring.

A joint with a low bending stiffness carries little moment, however unequal the pulls on its ring are. The
moment of a joint that is free to turn at its top falls linearly to zero, and its slope is the shear.
"""

import copy

import numpy as np
import pytest
from random_rigs import on_cylinders, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

SHARES = (0.25, 0.5, 0.75)


def unequal(seed, spatial, motion, stiffness=None):
    """A rig with a failed cylinder and a top that is free to turn, and its joint's ends (m)."""
    tree = on_cylinders(seed, "arrangement", spatial=spatial, conductor=False)
    tree["top"]["rotation"] = "free"
    tree["top"]["tensioners"]["failed"] = [0]
    tree["top"]["tensioners"]["arrangement"]["ring_radius"] = 1.0
    if stiffness:
        tree["top"]["telescopic_joint"]["bending_stiffness"] = stiffness
    tree["analysis"]["duration"] = 10.0 * tree["analysis"]["output"]["interval"]
    if not motion:
        tree["analysis"] = {"mesh": tree["analysis"]["mesh"]}
    ring = sum(section["length"] for section in tree["riser"])
    return tree, (ring, ring + tree["top"]["telescopic_joint"]["length"])


def found(tree):
    return run(SceneFile("rig.yaml", written(copy.deepcopy(tree))).resolved(), estimated=False).arrays


@pytest.mark.parametrize("motion", [False, True])
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(1, 4))
def test_a_soft_joint_has_little_shear(seed, spatial, motion):
    tree, (ring, top) = unequal(seed, spatial, motion, stiffness=1e7)
    arrays = found(tree)
    jump = np.abs(arrays["bending_moment_static"][-2])
    assert jump > 1e4  # the pulls bend the riser below the ring
    names = ["shear_force_static", *(["shear_force_max", "shear_force_min"] if motion else [])]
    for name in names:
        assert np.abs(arrays[name][..., -1]).max() < 0.1 * jump / (top - ring)
    if motion:
        tree["analysis"]["output"]["stations"] = [f"{ring + k * (top - ring)} m" for k in SHARES]
        assert np.abs(found(tree)["bending_moment"]).max() < 0.1 * jump


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_the_moment_in_a_joint_falls_to_zero_by_its_shear(seed, spatial):
    tree, (ring, top) = unequal(seed, spatial, motion=True)
    whole = found(tree)
    tree["analysis"]["output"]["stations"] = [f"{ring + k * (top - ring)} m" for k in SHARES]
    moments = found(tree)["bending_moment"]
    rest = whole["shear_force_static"][-1]
    peak = max(np.abs(whole["shear_force_max"][-1]), np.abs(whole["shear_force_min"][-1]))
    arms = (1.0 - np.array(SHARES)) * (top - ring)
    np.testing.assert_allclose(moments[0], (rest if spatial else -rest) * arms, 1e-6)
    forces = np.abs(moments / arms)
    np.testing.assert_allclose(forces, forces[:, :1] * np.ones(len(SHARES)), 1e-6)
    assert forces.max() <= (1.0 + 1e-6) * peak
    assert peak < 1.05 * forces.max()  # between two outputs


def test_the_largest_moment_includes_that_of_the_joint():
    larger = []
    for seed in range(6):
        tree, (ring, top) = unequal(seed, seed % 2 == 1, motion=True, stiffness=1e11)
        whole = run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False)
        shear = max(abs(whole.arrays[f"shear_force_{end}"][-1]) for end in ("max", "min"))
        largest = whole.facts["largest_bending_moment"]
        assert largest >= (1.0 - 1e-9) * shear * (top - ring)
        if shear * (top - ring) > 1.01 * np.abs(whole.arrays["bending_moment"]).max():  # than at all nodes
            larger.append(seed)
            assert whole.facts["largest_bending_moment_s"] == pytest.approx(ring)
    assert larger
