"""Strokes are counted from the riser in calm water, wherever motions without a ramp begin."""

import math

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def unramped(seed):
    """A rig whose motions begin displaced, on its mesh for two periods."""
    tree = moving(seed, spatial=bool(seed % 2), conductor=False)
    for motion in tree["platform"].values():
        motion.pop("ramp", None)
        if "amplitude" in motion:
            motion["phase"] = math.pi * (0.5 + seed % 2)
    return tree


def still(tree):
    """What a static run of a rig with its platform in calm water gives."""
    kept = ("position", "centre_of_rotation")
    platform = {name: part for name, part in tree["platform"].items() if name in kept}
    analysis = {"mesh": tree["analysis"]["mesh"]}
    return run_of({**tree, "platform": platform, "analysis": analysis})


def run_of(tree):
    return run(SceneFile("rig.yaml", written(tree)).resolved()).arrays


@pytest.mark.parametrize("seed", range(10))
def test_of_a_joint(seed):
    tree = unramped(seed)
    moved, rest = run_of(tree), still(tree)
    expected = moved["joint_stroke"] - rest["joint_stroke_static"]
    np.testing.assert_allclose(moved["stroke"], expected, atol=1e-6)
    assert abs(moved["stroke"][0]) > 0.1


@pytest.mark.parametrize("seed", range(4))
def test_of_upright_cylinders(seed):
    tree = unramped(seed)
    tree["platform"] = {name: tree["platform"][name] for name in ("position", "surge", "heave")}
    tree["top"] = {"x": "platform", "z": "free", "tensioners": upright(tree)}
    moved, rest = run_of(tree), still(tree)
    expected = moved["tensioner_stroke"][:, 0] - rest["tensioner_stroke_static"][0]
    np.testing.assert_allclose(moved["stroke"], expected, atol=1e-6)
    assert abs(moved["stroke"][0]) > 0.1


def upright(tree):
    """Cylinders that hold a rig without a joint."""
    weight = sum(one["length"] for one in tree["riser"]) * 3000.0
    law = {"tension": 0.5 * weight, "stiffness": 0.01 * weight}
    return {"count": 4, "mid_stroke": "riser unstretched", "linear": law}
