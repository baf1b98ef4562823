"""Mud above the riser decreases tension: limits on the smallest tension agree with the minimum tension."""

import math

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.dataset.limits import EXCEEDED, UNKNOWN, WITHIN, checked
from riserstudy.design import engine_tension
from riserstudy.design.tension import Tolerances
from riserstudy.scene.load import SceneFile
from riserstudy.scene.pressures import mud_above_the_riser
from riserstudy.simulation.refine import run


def pulled(seed, pull):
    """A rig in still water whose tensioners pull the ring up by a force (N), with mud up to the platform."""
    tree = rig(seed, spatial=bool(seed % 2), conductor=False)
    del tree["current"]
    tree["platform"]["position"].pop("sway", None)
    for section in tree["riser"]:
        section["buoyancy_lift"] = "0 N/m"
        section["contents"]["level"] = f"{tree['top']['elevation']} m"
    rigging, place = tree["top"]["tensioners"], tree["top"]["tensioners"]["arrangement"]
    joint = tree["top"]["telescopic_joint"]["length"]
    upright = joint / math.hypot(joint, place["deck_radius"] - place["ring_radius"])
    for name in ("gas", "table"):
        rigging.pop(name, None)
    rigging["linear"] = {"tension": pull / (rigging["count"] * upright), "stiffness": 3e4}
    rigging["mid_stroke"] = "riser in equilibrium"
    tree["limits"] = [{"output": "effective_tension", "smallest": "0 N", "mode": "drilling"}]
    tree["analysis"] = {"mesh": {"elements": 200}}
    return SceneFile("rig.yaml", written(tree))


@pytest.mark.parametrize("seed", range(6))
def test_a_tension_below_the_minimum_is_not_within_its_limit(seed):
    """Before, a run was within its limit at a pull that the minimum tension exceeds by the mud above."""
    scene = pulled(seed, 5e6).resolved()
    mud = mud_above_the_riser(scene)
    least = engine_tension.needed(scene, Tolerances(1.0, 1.0)).tension
    share = 1.0  # of the pull that arrives: the riser stretches, and the cylinders then lean more
    for beyond, verdict in ((0.0, None), (0.2, WITHIN), (-0.2, UNKNOWN), (-1.2, EXCEEDED)):
        file = pulled(seed, (least + beyond * mud) / share)
        found = run(file.resolved(), estimated=False)
        if verdict is None:
            joint = found.arrays["s_node"][-1] - scene.top.telescopic_joint.length
            ring = int(np.argmin(abs(found.arrays["s_node"] - joint)))
            share = float(found.arrays["effective_tension_static"][ring]) / least
            continue
        (limit,) = checked(file, file.resolved(), found.facts)
        assert limit.verdict == verdict, (beyond, limit)
        assert bool(limit.missing) == (verdict == UNKNOWN)
