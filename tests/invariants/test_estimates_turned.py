"""Estimated errors do not depend on the direction of the axes."""

import copy

import numpy as np
import pytest
from test_one_riser_written_twice import riser

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def moved(seed):
    """A riser in a current that turns over the depth, under a platform that heaves."""
    rng = np.random.default_rng(seed)
    tree = riser(z="platform", x="platform", held_at_tension=f"{rng.uniform(1500.0, 2500.0)} kN")
    del tree["top"]["tension"]
    tree["platform"] = {
        "heave": {"amplitude": f"{rng.uniform(0.02, 0.1)} m", "period": "10 s", "ramp": "10 s"}
    }
    run_of = {"duration": "30 s", "step": "0.25 s", "output": {"interval": "0.5 s"}}
    tree["analysis"] = {"mesh": {"elements": int(rng.integers(15, 30))}} | run_of
    turns = rng.uniform(-40.0, 40.0, 3)
    speeds = rng.uniform(0.2, 0.9, 3)
    return tree, turns, speeds


@pytest.mark.parametrize("seed", range(6))
def test_the_estimated_error_of_a_turned_riser_is_the_same(seed):
    tree, turns, speeds = moved(seed)
    found = []
    for heading in (5.0, 50.0, 140.0):
        turned = copy.deepcopy(tree)
        turned["current"] = {
            "profile": [
                {"elevation": f"{z} m", "speed": f"{speed} m/s", "direction": f"{heading + turn} deg"}
                for z, speed, turn in zip((-500, -200, 0), speeds, turns, strict=True)
            ],
            "beyond": "hold",
        }
        found.append(run(SceneFile("riser.yaml", turned).resolved()).facts["error_estimate"])
    for name in ("displacement", "tension", "moment"):
        values = [one[name] for one in found]
        assert max(values) <= 1.05 * min(values) + 1e-9, name
