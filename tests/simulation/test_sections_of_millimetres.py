"""A section of some millimetres, of the same pipe as its neighbours, changes no result on any mesh."""

import copy

import numpy as np
import pytest
from random_rigs import moving, written
from some_seeds import seeds

from riserstudy.model.mesh import even
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.run import single


def largest_moment(tree, halvings):
    """The largest moment (N m) in two periods from rest, on a mesh that is halved several times."""
    rig = copy.deepcopy(tree)
    period = rig["platform"]["surge"]["period"]
    rig["analysis"] |= {"duration": 2.0 * period, "output": {"interval": period / 16.0}}
    scene = SceneFile("rig.yaml", written(rig)).resolved()
    mesh = even(scene, 120)
    for _ in range(halvings):
        mesh = mesh.halved()
    return single(scene, mesh, period / 64.0).arrays["bending_moment_max"].max()


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", seeds(6, few=3))
def test_a_thin_section_changes_no_moment(seed, spatial):
    draw = np.random.default_rng((seed, 13))
    tree = moving(seed, spatial=spatial, conductor=False)
    cut = copy.deepcopy(tree)
    length, thin = tree["riser"][0]["length"], 10.0 ** draw.uniform(-4.0, -2.0)
    parts = [copy.deepcopy(tree["riser"][0]) for _ in range(3)]
    for part, name, own in zip(parts, "abc", (0.3 * length, thin, 0.7 * length - thin), strict=True):
        part |= {"name": name, "length": own}
    cut["riser"][:1] = parts
    for halvings in (1, 4):
        whole = largest_moment(tree, halvings)
        assert largest_moment(cut, halvings) == pytest.approx(whole, rel=2e-3)
