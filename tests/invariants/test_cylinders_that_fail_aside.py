"""Cylinders that fail, or keep open valves, during a run give the riser the freedom that they need.

A platform position of zero to one side adds no load, but gives a scene all freedoms: it may change nothing.
"""

import copy

import numpy as np
import pytest
from random_rigs import on_cylinders, written

from riserstudy import simulate
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

HISTORIES = {"x", "y", "z", "effective_tension", "bending_moment", "tensioner_stroke"}
FAR = 1e-3  # m: least motion aside that a test must show


def failing(seed):
    """A rig in a plane on inclined cylinders, of which one or two fail during the run."""
    draw = np.random.default_rng((seed, 9))
    tree = on_cylinders(seed, "arrangement", spatial=False, conductor=False)
    rig, duration = tree["top"]["tensioners"], tree["analysis"]["duration"]
    cylinders = draw.permutation(rig["count"]).tolist()
    rig["failing"] = {"at": f"{0.3 * duration!r} s", "cylinders": cylinders[: int(draw.integers(1, 3))]}
    return tree


def with_open_valves(seed):
    """A rig in a plane on gas cylinders, of which one keeps its recoil valve open after a disconnect."""
    draw = np.random.default_rng((seed, 10))
    tree = on_cylinders(seed, "arrangement", "gas", spatial=False, conductor=False)
    at = 0.4 * tree["analysis"]["duration"]
    tree["top"]["telescopic_joint"]["stop"] = {"collapse": "6 m", "stroke": "8 m", "stiffness": "5 MN/m"}
    tree["bottom"]["body"] = {"name": "LMRP", "mass": 7e4, "submerged_weight": "300 kN"}
    count = tree["top"]["tensioners"]["count"]
    valve = {
        "oil_density": "900 kg/m^3",
        "opening": "0.05 m^2",
        "discharge": 0.7,
        "residual": 0.05,
        "over": "1 s",
    }
    valve["failed"] = [int(draw.integers(count))]
    tree["disconnect"] = {"at": f"{at!r} s", "over": "0.3 s", "stack": {"stiffness": "100 MN/m"}}
    tree["disconnect"]["recoil_valve"] = valve
    return tree


def in_space(tree):
    tree = copy.deepcopy(tree)
    tree["platform"]["position"]["sway"] = 0.0
    return tree


@pytest.mark.parametrize("made", [failing, with_open_valves])
@pytest.mark.parametrize("seed", range(6))
def test_a_rig_that_could_move_aside_moves_no_further(seed, made):
    tree = made(seed)
    own, spatial = (SceneFile("rig.yaml", written(one)) for one in (tree, in_space(tree)))
    found, expected = (run(one.resolved(), estimated=False).arrays for one in (own, spatial))
    aside = np.abs(expected["y"]).max()
    assert ("y" in found) == (aside > FAR)
    for name in HISTORIES & {*found}:  # in a plane, moments have a sign
        scale = np.abs(expected[name]).max()
        assert np.abs(np.abs(found[name]) - np.abs(expected[name])).max() <= 1e-6 * scale, name


@pytest.mark.parametrize("seed", range(6))
def test_freedoms_are_those_of_cylinders_that_have_failed_before(seed):
    tree = failing(seed)
    before = copy.deepcopy(tree)
    before["top"]["tensioners"]["failed"] = before["top"]["tensioners"].pop("failing")["cylinders"]
    one, other = (SceneFile("rig.yaml", written(of)).resolved() for of in (tree, before))
    assert bool(one.spatial) == bool(other.spatial)


@pytest.mark.parametrize("seed", range(3))
def test_a_riser_that_only_moves_along_its_axis_bends_when_a_cylinder_fails(seed):
    """Without lateral loads it is modelled along its axis only, unless a cylinder is to fail to one side."""
    tree = failing(seed)
    del tree["current"]
    tree["platform"] = {"heave": tree["platform"]["heave"], "centre_of_rotation": {"elevation": 0.0}}
    tree["top"]["tensioners"]["failing"]["cylinders"] = [0]  # at a bearing of zero: on the x axis
    moved = simulate(SceneFile("rig.yaml", written(tree)), progress=False)
    assert float(np.abs(moved["x"]).max()) > FAR
