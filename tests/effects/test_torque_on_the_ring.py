"""A torque of the cylinders about the ring's axis bends nothing: the riser is free to twist."""

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy import load_scene, simulate
from riserstudy.scene.load import SceneFile

TURN = {"amplitude": "4 deg", "period": "10 s", "ramp": "10 s"}
RUN = {"duration": "20 s", "output": {"interval": "1 s"}, "mesh": {"elements": 48}, "step": "0.25 s"}


def moments(file):
    """Largest moment (N m) and largest deflection (m) under yaw, and the largest moment under pitch."""
    runs = [
        simulate(file.with_values({f"platform.{motion}": TURN}, "test"), progress=False)
        for motion in ("yaw", "pitch")
    ]
    yaw, pitch = (float(np.abs(run["bending_moment"]).max()) for run in runs)
    return yaw, float(np.abs(runs[0]["x"]).max()), pitch


@pytest.mark.parametrize("seed", range(6))
def test_a_platform_that_yaws_bends_no_upright_riser(seed):
    tree = rig(seed, spatial=True, conductor=False)
    del tree["current"], tree["platform"]["position"]
    file = SceneFile("rig.yaml", written(tree)).with_values({"analysis": RUN}, "test")
    yaw, aside, pitch = moments(file)
    assert aside < 1e-6
    assert yaw < 1e-6 * pitch


def test_nor_does_the_tensioner_system_of_a_paper():
    file = load_scene("config/scenes/liu2020/system.yaml").with_values({"analysis": RUN}, "test")
    yaw, aside, pitch = moments(file)
    assert aside < 1e-6
    assert yaw < 1e-6 * pitch
