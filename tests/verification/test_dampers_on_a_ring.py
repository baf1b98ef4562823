"""Dampers of inclined cylinders, whose arms resist a rotation of the ring, in Newton's iteration.

Over a short step they are much stiffer than the riser. Corrections that neglect this do not converge, or
leave short waves in the moment that a finer mesh and a shorter step make larger.
"""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.run import single
from riserstudy.simulation.starting_mesh import coarsest_mesh

STEPS = 3072  # a period
SHORTEST = 0.6  # segment (m)


def damped(seed, spatial):
    """A rig in motion on inclined cylinders with dampers, as a scene file has it, and its period (s)."""
    seeds = (k for k in range(seed, seed + 100) if has_arms(moving(k, spatial=spatial, conductor=False)))
    tree = moving(next(seeds), spatial=spatial, conductor=False)
    period = tree["platform"]["surge"]["period"]
    tree["analysis"] = {"duration": 0.7 * period, "output": {"interval": 0.1 * period}}
    tree = written(tree)
    strength = np.random.default_rng((seed, 2)).uniform(20.0, 150.0)
    tree["top"]["tensioners"]["damping"] = f"{strength!r} kN*s/m"
    return tree, period


def has_arms(tree):
    return "arrangement" in tree["top"].get("tensioners", {})


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(0, 40, 10))
def test_short_steps_converge_and_leave_no_noise_in_the_moment(seed, spatial):
    tree, period = damped(seed, spatial)
    found = []
    for tolerance in (None, 1e-13):
        tree["analysis"]["newton_tolerance"] = tolerance
        scene = SceneFile("rig.yaml", tree).resolved()
        mesh = coarsest_mesh(scene)
        while mesh.l0.min() > SHORTEST:
            mesh = mesh.halved()
        found.append(single(scene, mesh, period / STEPS))
    plain, exact = (run.arrays for run in found)
    scale = max(np.abs(exact[f"bending_moment_{end}"]).max() for end in ("max", "min"))
    for end in ("max", "min"):
        name = f"bending_moment_{end}"
        assert plain[name] == pytest.approx(exact[name], abs=1e-4 * scale), name
