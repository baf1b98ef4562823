"""Statistics of the angle of a lower flex joint in a study end with a disconnect, which opens the joint."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.dataset.extremes import statistic_of
from riserstudy.dataset.limits import takes
from riserstudy.scene.limits import UNITS, Limit
from riserstudy.scene.load import SceneFile
from riserstudy.study.collect import dataset_of, results_of
from riserstudy.study.sweep import as_study

pytestmark = pytest.mark.usefixtures("own_store")


def released(seed, spatial):
    """A rig in motion that disconnects in the middle of its run, and when (s)."""
    tree = moving(seed, spatial=spatial, conductor=False)
    at = 0.5 * tree["analysis"]["duration"]
    tree["top"]["telescopic_joint"]["stop"] = {"collapse": "4 m", "stiffness": "5 MN/m"}
    tree["disconnect"] = {"at": f"{at!r} s", "over": "0.3 s", "stack": {"stiffness": "20 MN/m"}}
    tree["analysis"] |= {"duration": at + 4.0, "output": {"interval": 0.2}}
    return tree, at


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_the_free_end_is_in_no_statistic_of_the_joint(seed, spatial):
    tree, at = released(seed, spatial)
    study = as_study(SceneFile("rig.yaml", written(tree)), {"note": ["one", "two"]}, ["lfj_angle"])
    found = dataset_of(study, results_of(study, 1, lambda _: None)[0])
    angle, time = found["lfj_angle"], found["time"].values
    assert np.isfinite(angle.values).all()  # the history itself is complete
    joined = angle.values[..., time <= at]
    for side, extreme in (("max", joined.max(axis=-1)), ("min", joined.min(axis=-1))):
        np.testing.assert_array_equal(statistic_of(found, "lfj_angle", side), extreme)
    after = angle.values[..., time > at]
    assert np.abs(after).max() > 1.01 * np.abs(joined).max()  # so that the test tests something


@pytest.mark.parametrize("seed", range(6))
def test_a_limit_says_whether_it_ends_with_a_disconnect(seed):
    tree, _ = released(seed, seed % 2 == 1)
    scene = SceneFile("rig.yaml", written(tree)).resolved()
    for output, unit in UNITS.items():
        for mode in ("drilling", "connected", "disconnect"):
            limit = Limit(output=output, mode=mode, largest=f"1 {unit}".replace("N/m^2", "Pa"))
            told = "until the disconnect" in takes(scene, limit)
            of_operation = mode != "disconnect" and output not in ("overpull", "lmrp_clearance")
            assert told == (of_operation or output == "lfj_angle"), (output, mode)
