"""A turned hull with RAOs, and valves beside another pull, are refused: their run would be another one."""

import math

import numpy as np
import pytest
from random_rigs import rig, written
from rigs_in_waves import in_waves

from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile

SEEDS = [(seed, bool(seed % 2)) for seed in range(4)]


def resolved(tree):
    return SceneFile("rig.yaml", written(tree)).resolved()


@pytest.mark.parametrize("seed, spatial", SEEDS)
def test_a_hull_turned_at_rest_has_no_raos(seed, spatial):
    turn = float(np.random.default_rng(seed).uniform(0.05, math.pi))
    tree = in_waves(seed, spatial, 3, "2 m", 10, 20.0, [0.5], [20])
    for whole in (0.0, 2.0 * math.pi):
        tree["platform"]["position"]["yaw"] = f"{whole!r} rad"
        resolved(tree)
    for part in (turn, -turn, math.pi):
        tree["platform"]["position"]["yaw"] = f"{part!r} rad"
        with pytest.raises(InputError, match=r"position.yaw: .* turns the hull, but not the RAOs"):
            resolved(tree)
    del tree["platform"]["response"]
    resolved(tree)


@pytest.mark.parametrize("seed, spatial", SEEDS)
def test_a_vessel_that_heads_elsewhere_has_no_raos(seed, spatial):
    tree = in_waves(seed, spatial, 3, "2 m", 10, 20.0, [0.5], [20])
    tree["top"]["x"] = "vessel"
    del tree["platform"]["position"]
    drag = "400000 N*s^2/m^2"
    tree["vessel"] = {"mass": "4.5e7 kg", "added_mass": "9e6 kg", "hull_drag": drag}
    tree["vessel"] |= {"wave_drift": {"force": "8e5 N"}, "sway": {"added_mass": "3e7 kg", "hull_drag": drag}}
    resolved(tree)
    tree["vessel"]["heading"] = f"{float(np.random.default_rng(seed).uniform(5.0, 355.0))!r} deg"
    with pytest.raises(InputError, match=r"vessel.heading: .* turns the hull, but not the RAOs"):
        resolved(tree)


@pytest.mark.parametrize("seed, spatial", SEEDS)
@pytest.mark.parametrize("pull", ["top.tensioners", "top.telescopic_joint.tension"])
def test_valves_of_a_constant_tension_are_refused_beside_another_pull(seed, spatial, pull):
    """They would leave the other pull, and so more than the share of the hanging weight that they hold."""
    tree = rig(seed, spatial=spatial, conductor=False)
    top = tree["top"]
    other = {"top.tensioners": top.pop("tensioners"), "top.telescopic_joint.tension": "900 kN"}[pull]
    top["tension"] = "14 MN"
    tree["disconnect"] = {"at": "5 s", "valve": {"hold": 0.9, "over": "2 s"}}
    tree["analysis"] = {"duration": 20.0, "step": 0.1, "mesh": {"elements": 20}, "output": {"interval": 0.5}}
    resolved(tree)
    where, name = (top, "tensioners") if pull == "top.tensioners" else (top["telescopic_joint"], "tension")
    where[name] = other
    with pytest.raises(InputError, match=f"changes top.tension only, but {pull} also pulls"):
        resolved(tree)
