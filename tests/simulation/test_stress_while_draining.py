"""The wall's stress needs the pressure of contents at rest: while they drain, it is not evaluated."""

import copy

import numpy as np
import pytest
from random_rigs import rig, timed, written

from riserstudy import simulate
from riserstudy.scene.limit_inputs import lacks
from riserstudy.scene.load import SceneFile


def released(seed, **release):
    """A rig whose LMRP is released after half a second, with a limit on the stress of its wall."""
    tree = rig(seed, conductor=False)
    tree["analysis"] = timed(1.0, 0.02, 16, 0.1)
    scene = written(tree)
    for part in scene["riser"]:
        part["contents"] = {"density": "1800 kg/m^3"}
    scene["bottom"]["body"] = {"name": "LMRP", "mass": "100 t", "submerged_weight": "800 kN"}
    scene["top"]["telescopic_joint"]["tension"] = "3 MN"  # lifts the LMRP off
    scene["limits"] = [{"output": "von_mises_stress", "largest": "300 MPa", "mode": "drilling"}]
    scene["disconnect"] = {"at": "0.5 s", "over": "0.3 s", **release}
    return scene


@pytest.mark.parametrize("seed", range(6))
def test_stress_is_evaluated_only_where_the_contents_stay(seed):
    """The static scene has the same pressures with and without draining; its stress is known."""
    stay = SceneFile("stay", released(seed), {}).resolved()
    drain = SceneFile("drain", released(seed, drain={"friction": 0.02}), {})
    limit = stay.limits[0]
    assert lacks(stay, limit) == []
    assert all("contents" in lack for lack in lacks(drain.resolved(), limit))
    assert len(lacks(drain.resolved(), limit)) == len(stay.riser)
    run = simulate(drain)
    assert not [name for name in run if "von_mises" in name and np.isfinite(run[name]).any()]
    still = copy.deepcopy(drain.tree)
    still["analysis"] = {"mesh": {"elements": 16}}
    del still["disconnect"]
    assert np.isfinite(simulate(SceneFile("still", still, {}))["von_mises_stress_static"]).any()
