"""Screening for vortex-induced vibration does not depend on how a scene is written: seeded rigs."""

import numpy as np
import pytest
from changes import in_other_units, lifted, mirrored, rotated
from random_rigs import moving, written

from riserstudy.design.vortex_screening import screening
from riserstudy.scene.load import SceneFile

NUMBERS = ("natural_frequency", "excited_length", "amplitude", "amplitude_limit", "drag_factor")


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("way", [in_other_units, lifted, mirrored, rotated])
def test_a_scene_written_otherwise_has_the_same_modes(seed, way):
    tree = moving(seed)
    if way is rotated and "sway" not in tree["platform"]:
        pytest.skip("in space its modes are those across the plane, below")
    other = way(tree, np.random.default_rng((seed, 7)))
    one, two = (screening(SceneFile("rig.yaml", t)) for t in (written(tree), other.tree))
    assert one["mode"].values.tolist() == two["mode"].values.tolist()
    for name in NUMBERS:
        np.testing.assert_allclose(two[name], one[name], rtol=1e-5, atol=1e-9, err_msg=name)


@pytest.mark.parametrize("seed", range(12))
def test_in_space_only_modes_across_the_flow_are_excited(seed):
    """A rig in a plane that is turned has as many modes as in its plane, those along the flow left out.

    Its modes across the plane differ from those in it by its sag alone.
    """
    tree = moving(seed, spatial=False)
    tree["platform"].pop("pitch", None)
    turned = rotated(tree, np.random.default_rng((seed, 7)))
    one, two = (screening(SceneFile("rig.yaml", t)) for t in (written(tree), turned.tree))
    assert two.sizes["mode"] == one.sizes["mode"]
    for name in NUMBERS:
        np.testing.assert_allclose(two[name], one[name], rtol=5e-3, err_msg=name)
