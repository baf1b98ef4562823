"""Structural damping is that of the pipe: at a flex joint the moment is its stiffness times its angle."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy import simulate
from riserstudy.scene.load import SceneFile

STIFF = {"top": 1e6, "bottom": 2e6}  # N m/rad
#: with damping in the joints, it was 0.4 to 10 %
ALLOWED = 4e-3


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_a_flex_joint_is_elastic_below_a_damped_pipe(seed, spatial):
    tree = moving(seed, spatial=spatial, conductor=False)
    for section in tree["riser"]:
        section["structural_damping"] = {"ratio": 0.2, "at_period": 2.0}
    for end, stiffness in STIFF.items():
        tree[end]["rotation"] = {"stiffness": stiffness}
    tree["analysis"]["mesh"]["elements"] = 150
    run = simulate(SceneFile("rig.yaml", written(tree)))
    for end, angle, place in (("top", "ufj_angle", -1), ("bottom", "lfj_angle", 0)):
        moment = abs(run["bending_moment"].transpose("time", ...).values[:, place])
        elastic = STIFF[end] * abs(run[angle].values)
        np.testing.assert_allclose(elastic, moment, rtol=0.0, atol=ALLOWED * moment.max())
