"""Equilibria of rigs whose platform is so far from the well that cylinders reach their stops."""

import math

import numpy as np
import pytest
from random_rigs import rig, written
from scipy.spatial.transform import Rotation

from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.equilibrium import settle

LONGEST = 8.0  # m
STIFFNESS = 5e7  # N/m


def at_stops(seed, spatial, conductor):
    """A rig at an offset that lengthens the line from foot to platform by 0.5 to 3 m more than the stroke."""
    draw, tree = np.random.default_rng(seed), rig(seed, spatial=spatial, conductor=conductor)
    depth = -tree["water"]["seabed"]
    longer = LONGEST + float(draw.uniform(0.5, 3.0))
    tree["platform"]["position"]["surge"] = math.sqrt(2.0 * depth * longer) * float(draw.choice([-1.0, 1.0]))
    del tree["current"]
    stops = {"shortest": f"{-LONGEST} m", "longest": f"{LONGEST} m", "stop_stiffness": f"{STIFFNESS} N/m"}
    scene = written(tree)
    scene["top"]["tensioners"] |= {"stroke": stops, "mid_stroke": "riser in equilibrium"}
    return SceneFile("rig.yaml", scene).resolved()


@pytest.mark.parametrize("conductor", [False, True])
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(9))
def test_cylinders_at_their_stops_carry_the_riser(seed, spatial, conductor):
    """The riser as a free body: pulls from positions alone, weight, and the force at its foot balance.

    Cylinders at one side of the ring bend riser and joint. The vertical part of the joint's shear, and the
    bend between the last node and the ring, are left out; they make up to 1.3 % of the pulls.
    """
    scene = at_stops(seed, spatial, conductor)
    mesh = even(scene, 60)
    model, found = settle(scene, mesh)
    s, rig_of, place = model.s, scene.top.tensioners, scene.platform.position
    ring, below = (np.zeros(3), np.zeros(3))
    ring[[0, -1]], below[[0, -1]] = s.r[[0, -1], mesh.ring], s.r[[0, -1], mesh.ring - 1]
    if spatial:
        ring[1], below[1] = s.r[1, mesh.ring], s.r[1, mesh.ring - 1]
    at = rig_of.arrangement
    bearings = at.first_bearing + 2.0 * np.pi * np.arange(rig_of.count) / rig_of.count
    around = np.stack([np.cos(bearings), np.sin(bearings), np.zeros(rig_of.count)], axis=1)
    deck = at.deck_radius * around + [place.surge, place.sway or 0.0, at.deck_elevation]
    axis = (ring - below) / np.linalg.norm(ring - below)
    tilted, _ = Rotation.align_vectors([axis], [[0.0, 0.0, 1.0]])
    line = deck - ring - tilted.apply(at.ring_radius * around)
    upward = line[:, 2] / np.linalg.norm(line, axis=1)
    weight = sum(
        (one.submerged_weight + 9.80665 * one.contents_mass) * one.total_length for one in scene.riser
    )
    foot = float(s.segment[-1, 0])
    assert max(s.reach) > LONGEST
    lifted = float(np.array(s.pull) @ upward)
    assert lifted == pytest.approx(foot + weight, rel=0.02)
    assert found.residual < 1e-5 * lifted
