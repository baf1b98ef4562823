"""Bodies at the riser's ends: their weight in air above the water, and who carries it."""

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy import simulate
from riserstudy.scene.load import SceneFile


def ringed(seed, body):
    """Tensions at rest (N) of a rig with a tension ring, at an elevation above or below the surface."""
    draw = np.random.default_rng((seed, 8))
    tree = rig(seed, conductor=False)
    tree["analysis"] = {"mesh": {"elements": 30}}
    ring = tree["top"]["elevation"] - tree["top"]["telescopic_joint"]["length"]
    tree["water"]["surface"] = ring + float(draw.choice([-3.0, 0.0, 3.0]))
    tree["current"]["profile"]["surface_speed"] = 0.0
    scene = written(tree)
    wet = tree["water"]["surface"] > ring
    scene["top"]["body"] = body(wet, tree["gravity"])
    return simulate(SceneFile("ring", scene, {}))["effective_tension_static"].values, wet


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("given", ["density", "displaced_volume"])
def test_a_ring_loses_the_weight_of_water_only_below_the_surface(seed, given):
    """Once by what it displaces, and once by its weight."""
    mass, volume = 40e3, 8.0

    def displacing(_wet, _gravity):
        by = f"{mass / volume} kg/m^3" if given == "density" else f"{volume} m^3"
        return {"name": "ring", "mass": f"{mass} kg", given: by}

    def weighing(wet, gravity):
        weight = gravity * (mass - (1025.0 * volume if wet else 0.0))
        return {"name": "ring", "mass": f"{mass} kg", "submerged_weight": f"{weight!r} N"}

    np.testing.assert_allclose(ringed(seed, displacing)[0], ringed(seed, weighing)[0], rtol=1e-9)


def test_both_kinds_of_places_are_drawn():
    def none(_wet, _gravity):
        return {"name": "ring", "mass": "1 kg"}

    assert {ringed(seed, none)[1] for seed in range(12)} == {True, False}


@pytest.mark.parametrize("seed", range(6))
def test_a_ring_does_not_change_the_tension_that_follows_from_a_buoyant_factor(seed):
    draw = np.random.default_rng((seed, 9))
    tree = rig(seed, spatial=False, conductor=False)
    for part in tree["riser"]:
        part.pop("submerged_weight")
    tree["analysis"] = {"mesh": {"elements": 30}}
    tree["top"] = {"x": "platform", "z": "free", "rotation": "free"}
    scene = written(tree)
    scene["buoyancy"] = {
        "factor": float(draw.uniform(0.2, 0.8)),
        "tension_ratio": float(draw.uniform(1.2, 1.6)),
        "reading": str(draw.choice(["R1", "R2", "R3"])),
    }
    bare = simulate(SceneFile("bare", scene, {}))
    weight = f"{draw.uniform(50, 900)} kN"
    scene["top"]["body"] = {"name": "ring", "mass": "40 t", "submerged_weight": weight}
    ringed = simulate(SceneFile("ringed", scene, {}))
    name = "effective_tension_static"
    np.testing.assert_allclose(ringed[name].values, bare[name].values, rtol=1e-6)
