"""A disconnect ends the angle of the lower flex joint: limits do not judge the free end after it."""

import copy

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def released(seed):
    """A rig in motion, in plane or space, whose lower end is let go with an LMRP at a step of the run."""
    tree = moving(seed, spatial=seed % 2 == 1, conductor=False)
    analysis = tree["analysis"]
    step = analysis["step"]
    analysis["output"]["interval"] = step
    analysis["method"] = {"rho_inf": 0.8}  # the default of a run with events is another
    at = round(0.7 * analysis["duration"] / step) * step
    tree["top"]["telescopic_joint"]["stop"] = {"collapse": "4 m", "stiffness": "5 MN/m"}
    tree["bottom"]["body"] = {"name": "LMRP", "mass": 7e4, "submerged_weight": "300 kN"}
    stack = {"stiffness": "100 MN/m"}
    tree["disconnect"] = {"at": f"{at!r} s", "over": "0.3 s", "stack": stack}
    tree["limits"] = [
        {"output": "lfj_angle", "largest": f"{angle} deg", "mode": "drilling"} for angle in (0.01, 0.3, 60)
    ]
    tree["limits"].append({"output": "lfj_angle", "mean": "1 deg", "mode": "drilling"})
    held = copy.deepcopy(tree)
    del held["disconnect"]
    held["analysis"]["duration"] = at
    return tree, held


@pytest.mark.parametrize("seed", range(8))
def test_limits_judge_what_a_run_until_the_disconnect_has(seed):
    free, held = (
        run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False) for tree in released(seed)
    )

    def angle(of):
        return next(row for row in of.facts["extremes"] if row["output"] == "lfj_angle")

    one, other = angle(held), angle(free)
    for side in ("largest", "smallest", "mean"):
        assert other[side] == pytest.approx(one[side], rel=1e-4, abs=1e-6), side
    for then, now in zip(held.facts["limits_reached"], free.facts["limits_reached"], strict=True):
        assert now == then if isinstance(then, str) else now == pytest.approx(then, rel=1e-6)
    history, time = free.arrays["lfj_angle"], free.arrays["time"]
    assert len(history) == len(time)
    assert np.isfinite(history).all()
