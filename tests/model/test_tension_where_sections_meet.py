"""Effective tension at the ends of short and long, heavy and buoyant sections, from sums of their weights."""

import copy
import math
import random

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.design.engine_tension import needed
from riserstudy.design.tension import Tolerances
from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.run import single

GRAVITY = 9.80665


def of_joints(seed, spatial):
    """A rig without current of 12 to 40 joints, some of them pups of 0.3 m to 6 m, and some buoyant."""
    tree = rig(seed, spatial=spatial, conductor=False)
    del tree["current"]
    draw = random.Random(seed)
    length = sum(section["length"] for section in tree["riser"])
    first = tree["riser"][0]
    inside = first["contents"]["density"] * GRAVITY * 0.25 * math.pi * first["inner_diameter"] ** 2
    count = draw.randint(12, 40)
    long = [draw.random() < 0.7 for _ in range(count)]
    short = [0.0 if one else draw.uniform(0.3, 6.0) for one in long]
    each = (length - sum(short)) / max(sum(long), 1)
    sections = []
    for k in range(count):
        net = draw.choice([-1500.0, 0.0, 1000.0, 4000.0]) * draw.uniform(0.5, 1.0)
        section = copy.deepcopy(first) | {"name": f"joint {k}", "submerged_weight": net - inside}
        section |= {"length": each if long[k] else short[k], "buoyancy_lift": 0.0}
        sections.append(section)
    tree["riser"] = sections
    weight = [(section["submerged_weight"] + inside) * section["length"] for section in sections]
    return tree, np.array(weight)


def resolved(tree):
    return SceneFile("rig.yaml", written(tree, unit_of={"buoyancy_lift": "N/m"})).resolved()


def at_ends(tree, elements):
    """Effective tension at the ends of the sections of a rig at rest, from below (N)."""
    tree["analysis"] = {"mesh": {"elements": elements}}
    scene = resolved(tree)
    mesh = even(scene, elements)
    run = single(scene, mesh, None).arrays
    nodes = [mesh.foot(k) for k in range(len(scene.riser))]
    return run["effective_tension_static"][[*nodes, mesh.ring]]


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_the_tension_between_two_ends_differs_by_the_weight(seed, spatial):
    """On any mesh, down to one segment a section; the riser leans by less than 2 deg."""
    for elements in (1, 60, 150):
        tree, weight = of_joints(seed, spatial)
        tension = at_ends(tree, elements)
        off = np.diff(tension) - weight
        assert np.abs(off).max() < 1e-3 * np.abs(weight).max(), elements


@pytest.mark.parametrize("seed", range(6))
def test_the_tension_that_keeps_every_end_taut_is_the_largest_sum_above(seed):
    """Without a mesh in the scene, the engine finds it on its coarsest mesh."""
    tree, weight = of_joints(seed, False)
    above = np.append(np.cumsum(weight[::-1])[::-1], 0.0)
    slack = needed(resolved(tree), Tolerances(1.0, 1.0))
    assert slack.tension == pytest.approx(above.max(), rel=1e-3)
