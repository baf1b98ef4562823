"""Mud above the riser decreases tension: limits on tension and overpull agree with the minimum tension."""

import json
import math
from types import SimpleNamespace

import numpy as np
import pytest
from random_rigs import rig, timed, written

from riserstudy.dataset.limits import EXCEEDED, UNKNOWN, WITHIN, checked
from riserstudy.dataset.recoil_table import recoil
from riserstudy.design import engine_tension
from riserstudy.design.tension import Tolerances
from riserstudy.design.window import lift_off
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


def disconnected(seed, **limit):
    """A rig pulled at 9 MN whose LMRP disconnects, with its run."""
    file = pulled(seed, 9e6).with_values(
        {
            "bottom.body": {"name": "LMRP", "mass": "90 t", "density": "7850 kg/m^3"},
            "bottom.rotation": None,
            "disconnect": {"at": "0.5 s", "over": "0.2 s"},
            "analysis": timed("1 s", "0.02 s", 60, "0.1 s"),
            "limits": [{"output": "overpull", "mode": "disconnect", **limit}],
        },
        "test",
    )
    return file, run(file.resolved(), estimated=False)


@pytest.mark.parametrize("seed", range(6))
def test_an_overpull_without_the_mud_above_is_not_within_its_limit(seed):
    """Before, a run was within a limit at a pull that the lift-off with this overpull exceeds."""
    file, found = disconnected(seed, smallest="0 N")
    scene, overpull = file.resolved(), found.facts["overpull"]
    mud = mud_above_the_riser(scene)
    joint = found.arrays["s_node"][-1] - scene.top.telescopic_joint.length
    ring = int(np.argmin(abs(found.arrays["s_node"] - joint)))
    beyond = float(found.arrays["effective_tension_static"][ring]) - lift_off(scene, 0.0)
    assert overpull - mud == pytest.approx(beyond, abs=1e-5 * 9e6)
    for left, verdict in ((1.1, WITHIN), (0.9, UNKNOWN), (-0.1, EXCEEDED)):
        file, found = disconnected(seed, smallest=f"{overpull - left * mud!r} N")
        (limit,) = checked(file, file.resolved(), found.facts)
        assert limit.verdict == verdict, (left, limit)
    attributes = found.facts | {"extremes": json.dumps(found.facts["extremes"])}
    rows = {row[0]: row for row in recoil(scene, SimpleNamespace(attrs=attributes)).rows}
    assert f"{1e-3 * mud:.3g} kN" in rows["overpull"][-1]
