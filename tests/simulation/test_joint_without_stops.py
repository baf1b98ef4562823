"""A riser that recoils into its telescopic joint: the run says so, and a stop keeps the joint long."""

import math

import pytest
from random_rigs import LAWS, at_mid_stroke, rig, written

from riserstudy.errors import StepFailed
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def recoiling(seed, *, spatial):
    """A rig that lets go of the well with soft cylinders, without any stop."""
    tree = rig(seed, spatial=spatial, conductor=False)
    of = tree["top"]["tensioners"]
    pull = at_mid_stroke(of)
    for name in LAWS:
        of.pop(name, None)
    of["linear"] = {"tension": pull, "stiffness": 0.01 * pull}
    area = {"horizontal": "30 m^2", "vertical": "10 m^2"}
    tree["bottom"]["body"] = {"name": "LMRP", "mass": 6e4, "density": "7850 kg/m^3", "drag_area": area}
    for section in tree["riser"]:
        section["structural_damping"] = {"ratio": 0.01, "at_period": 4.0}
    tree["disconnect"] = {"at": "2 s", "over": "0.2 s"}
    tree["analysis"] = {"duration": 25.0, "output": {"interval": 0.5}, "step": 0.05}
    tree["analysis"]["mesh"] = {"elements": 30}
    return tree


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_a_joint_that_is_compressed_to_nothing_is_named(seed, spatial):
    """Some runs fail at it, and others get by with a joint that is as good as gone."""
    tree = recoiling(seed, spatial=spatial)
    scene = SceneFile("rig.yaml", written(tree)).resolved()
    found, failed = None, ""
    try:
        found = run(scene, estimated=False)
    except StepFailed as failure:
        failed = str(failure)
    if found is None:
        assert "The telescopic joint is compressed from" in failed
        assert "nan" not in failed
        return
    length = tree["top"]["telescopic_joint"]["length"]
    shortest = length + float(found.arrays["joint_stroke"].min())
    assert shortest < 0.5 * length
    (warning,) = [text for text in sentences(found.facts["warnings"]) if "two barrels cannot" in text]
    assert "is compressed to" in warning
    assert float(warning.split("is compressed to ")[1].split()[0]) <= 1.005 * shortest


@pytest.mark.parametrize("seed", range(3))
def test_nor_does_it_fail_with_a_stop(seed):
    tree = recoiling(seed, spatial=False)
    joint = tree["top"]["telescopic_joint"]
    joint["stop"] = {"collapse": f"{0.4 * joint['length']} m", "stiffness": "5 MN/m"}
    found = run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False)
    assert not [text for text in sentences(found.facts["warnings"]) if "two barrels cannot" in text]
    assert math.isfinite(found.facts["smallest_tension"])
    assert found.arrays["joint_stroke"].min() > -joint["length"]
