"""Water exerts no force on a conductor in the soil: seeded rigs on conductors, in plane and space."""

import copy

import numpy as np
import pytest
from random_rigs import FOOT, moving, rig, written

from riserstudy import simulate
from riserstudy.model.build import build
from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile

NUMBERS = ("x", "z", "bending_moment", "effective_tension")
WAVE = {"height": "4 m", "period": "11 s", "ramp": "5 s", "above_mean_level": "stretched"}


def bare(tree):
    """The rig whose conductor, which is all below the mudline, has neither drag nor added mass."""
    tree = copy.deepcopy(tree)
    for name in ("drag", "added_mass"):
        del tree["riser"][0][name]
    return tree


def scene(tree):
    return SceneFile("rig.yaml", written(tree))


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_in_waves_and_current_a_conductor_in_soil_feels_no_water(seed, spatial):
    tree = moving(seed, spatial=spatial, conductor=True)
    tree["wave"] = WAVE
    tree["current"] = {"profile": {"shape": "uniform", "surface_speed": 0.8}}
    one, two = (simulate(scene(t)) for t in (tree, bare(tree)))
    for name in NUMBERS:
        np.testing.assert_array_equal(one[name].values, two[name].values, err_msg=name)


@pytest.mark.parametrize("seed", range(12))
def test_loads_are_those_of_the_length_above_the_mudline(seed):
    draw = np.random.default_rng(seed)
    tree = rig(seed, conductor=True)
    exposed = float(draw.uniform(0.0, 0.9)) * FOOT  # scour around the conductor
    tree["soil"]["mudline"] -= exposed
    resolved = scene(tree).resolved()
    model = build(resolved, even(resolved, int(draw.integers(20, 200))))
    length = [section["length"] for section in tree["riser"]]
    for name, of_metre in (
        ("drag", lambda s: 0.5 * 1025.0 * s["drag"]["coefficient"] * s["drag"]["diameter"]),
        ("added mass", lambda s: 1025.0 * 0.25 * np.pi * s["added_mass"]["diameter"] ** 2),
    ):
        (record,) = (effect.record for effect in model.effects if effect.name == name)
        total = sum(record.low if name == "drag" else record.mass)
        wanted = sum(a * of_metre(s) for a, s in zip([exposed, *length[1:]], tree["riser"], strict=True))
        assert total == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_at_rest_a_current_does_not_push_a_conductor_in_soil(seed):
    tree = rig(seed, conductor=True)
    tree["current"] = {"profile": {"shape": "uniform", "surface_speed": 1.0}}
    tree["analysis"] = {"mesh": {"elements": 100}}
    one, two = (simulate(scene(t)) for t in (tree, bare(tree)))
    for name in NUMBERS:
        np.testing.assert_array_equal(one[name].values, two[name].values, err_msg=name)
