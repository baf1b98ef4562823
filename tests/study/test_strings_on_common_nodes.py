"""A riser that only heaves, on cylinders: values between nodes do not depend on the mesh.

The telescopic joint strokes, so the motion along the riser has a kink at the tension ring. A smooth curve
through the nodes on both sides of the ring would overshoot.
"""

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.refine import run
from riserstudy.study.collect import laid_on

AMPLITUDE = 3.0  # m
NEAR = 1e-4  # of the amplitude, between meshes


def heaving(seed):
    """A rig that moves along its axis only, on upright cylinders, below a platform that heaves."""
    tree = rig(seed, spatial=False, conductor=False)
    draw = np.random.default_rng(seed)
    tree["platform"] = {
        "heave": {"amplitude": AMPLITUDE, "period": float(draw.uniform(8.0, 14.0)), "ramp": 8.0}
    }
    del tree["current"], tree["bottom"]["rotation"], tree["top"]["rotation"], tree["top"]["x"]
    del tree["top"]["tensioners"]["arrangement"]
    for section in tree["riser"]:
        del section["drag"], section["added_mass"]
    tree["analysis"] = {"duration": 30.0, "output": {"interval": 0.5}, "step": 0.1, "method": "ESDIRK4"}
    return tree


@pytest.mark.parametrize("seed", range(6))
def test_envelopes_between_nodes_are_those_of_another_mesh(seed):
    tree, draw = heaving(seed), np.random.default_rng(100 + seed)
    few = int(draw.integers(20, 40))
    runs = []
    for count in (few, few + int(draw.integers(1, 9))):
        tree["analysis"]["mesh"] = {"elements": count}
        runs.append(run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False))
    one, other = runs
    assert np.ptp(one.arrays["stroke"]) > AMPLITUDE  # the joint strokes
    laid = laid_on(one, other.arrays["s_node"]).arrays
    for name in ("z_max", "z_min", "z_static"):
        assert np.abs(laid[name] - other.arrays[name]).max() < NEAR * AMPLITUDE, name
    assert difference(one, other)["displacement"] < NEAR
