"""Screening for vortex-induced vibration does not depend on how a scene is written: seeded rigs."""

import numpy as np
import pytest
from changes import in_other_units, lifted, mirrored, rotated
from random_rigs import moving, rig, written

from riserstudy.design.vortex_screening import Coefficients, flow_along, screening
from riserstudy.errors import InputError
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


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("bare", [False, True])
def test_vortices_are_shed_in_water_only_and_drag_acts_there_only(seed, bare):
    """Neither in the soil around a conductor, with and without drag of its own, nor above the surface."""
    tree = rig(seed, conductor=True)
    profile = [{"elevation": z, "speed": 0.7} for z in (tree["water"]["seabed"], 0.0)]
    tree["current"] = {"profile": profile, "beyond": "hold"}
    if bare:
        del tree["riser"][0]["drag"]
    file = SceneFile("rig.yaml", written(tree))
    found = screening(file)
    assert found.sizes["mode"] > 0
    assert found["excited_from"].min() >= tree["water"]["seabed"]
    assert found["excited_to"].max() <= 0.0
    assert np.isfinite(found["amplitude_limit"]).all()
    flow = flow_along(file.resolved(), Coefficients(drag=1.1))
    dry = (flow.z > 0.0) | (flow.z < tree["water"]["seabed"])
    assert dry.any()
    assert (flow.drag[dry] == 0.0).all()
    assert (flow.speed[dry] == 0.0).all()
    assert flow.drag[~dry & (flow.speed > 0.0)] == pytest.approx(1.1)


@pytest.mark.parametrize("seed", range(4))
def test_a_towed_riser_is_refused(seed):
    tree = rig(seed)
    tree["platform"]["cruise"] = {"speed": 0.5, "heading": "20 deg"}
    with pytest.raises(InputError, match=r"platform\.cruise"):
        screening(SceneFile("rig.yaml", written(tree)))
