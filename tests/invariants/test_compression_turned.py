"""A riser in compression has the same warning whichever way the plane of its motion lies."""

import copy

import numpy as np
import pytest
from test_one_riser_written_twice import riser

from riserstudy.errors import SimulationError
from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def compressed(seed, moving):
    """A riser whose tension is far too small for its heave, or its weight; sometimes large enough."""
    rng = np.random.default_rng(seed)
    if moving:
        tree = riser(z="platform", x="platform", held_at_tension=f"{rng.uniform(1000.0, 1600.0)} kN")
        del tree["top"]["tension"]
        heave = {"amplitude": f"{rng.uniform(0.02, 0.2)} m", "period": "10 s", "ramp": "10 s"}
        tree["platform"] = {"heave": heave}
        run_of = {"duration": "25 s", "step": "0.1 s", "output": {"interval": "0.5 s"}}
    else:
        tree, run_of = riser(tension=f"{rng.uniform(250.0, 900.0)} kN"), {}
    tree["current"] = {"profile": {"shape": "uniform", "surface_speed": f"{rng.uniform(0.2, 0.7)} m/s"}}
    tree["analysis"] = {"mesh": {"elements": 40}} | run_of
    return tree


@pytest.mark.parametrize("moving", [False, True])
@pytest.mark.parametrize("seed", range(5))
def test_the_warning_of_compression_is_that_of_the_same_riser_turned(seed, moving):
    tree, found = compressed(seed, moving), []
    for heading in (0.0, 30.0, 118.0, -75.0):
        turned = copy.deepcopy(tree)
        turned["current"]["heading"] = f"{heading} deg"
        try:
            result = run(SceneFile("riser.yaml", turned).resolved(), estimated=False)
        except SimulationError as error:
            found.append([str(error)])
        else:
            found.append([one for one in sentences(result.facts["warnings"]) if "tension" in one])
    assert all(one == found[0] for one in found)


def test_a_riser_that_is_moved_out_of_its_plane_may_buckle_in_every_direction():
    tree = compressed(1, moving=True)
    tree["platform"]["heave"]["amplitude"] = "0.2 m"
    tree["current"]["profile"] = [
        {"elevation": "-500 m", "speed": "0.5 m/s", "direction": "10 deg"},
        {"elevation": "0 m", "speed": "0.5 m/s", "direction": "50 deg"},
    ]
    tree["current"]["beyond"] = "hold"
    found = run(SceneFile("riser.yaml", tree).resolved(), estimated=False)
    assert found.facts["smallest_tension"] < 0.0
    assert not [one for one in sentences(found.facts["warnings"]) if "out of its plane" in one]
