"""Meshes that a scene prescribes: as many segments as asked for, the finer the closer to a layer."""

from pathlib import Path

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.model.mesh import mesh_of as mesh_again
from riserstudy.model.mesh import prescribed
from riserstudy.scene.load import SceneFile, read_scene
from riserstudy.simulation.starting_mesh import coarsest_mesh

SCENES = Path(__file__).parents[2] / "config" / "scenes"
LAYERS = {"top": "7 m", "bottom": "14 m"}


def mesh_of(elements, name="mao_hangoff/hangoff_ref", **sets):
    values = {"analysis": {"mesh": {"elements": elements, "layers": LAYERS}}, "platform": None}
    sets = {path.replace("__", "."): value for path, value in sets.items()}
    held = {"top.x": "held", "top.z": "held", "current.ramp": None}
    file = read_scene(SCENES / f"{name}.yaml").with_values(values | held | sets, "test")
    return prescribed(file.resolved(), elements)


@pytest.mark.parametrize("elements", [30, 100, 333])
def test_layers_leave_number_and_length_and_are_followed_at_both_ends(elements):
    l0 = mesh_of(elements).l0
    assert len(l0) == pytest.approx(elements, abs=1)
    assert l0.sum() == pytest.approx(1800.0, rel=1e-12)
    longest = int(l0.argmax())
    assert (np.diff(l0[: longest + 1]) > -1e-6).all()
    assert (np.diff(l0[longest:]) < 1e-6).all()
    assert l0[-1] < 0.6 * l0[0] < 0.1 * l0.max()


def test_nodes_do_not_depend_on_the_tension():
    heavy, light = (mesh_of(100, bottom__body__submerged_weight=w).s for w in ("9 MN", "0.5 MN"))
    np.testing.assert_array_equal(heavy, light)


def test_one_end_may_have_a_layer():
    l0 = mesh_of(100, analysis__mesh={"elements": 100, "layers": {"top": "7 m"}}).l0
    assert l0[0] == pytest.approx(l0.max(), rel=1e-9)
    assert l0[-1] < 0.1 * l0[0]


def test_half_the_segments_are_spread_alike():
    """The error estimate compares with such a mesh."""
    fine, coarse = mesh_of(200).s, mesh_of(100).s
    np.testing.assert_allclose(fine[::2], coarse, atol=0.05)


def test_sections_keep_their_lengths():
    found = mesh_of(120, **{"riser": SECTIONS})
    for k, length in enumerate((300.0, 1500.0)):
        assert found.l0[found.section == k].sum() == pytest.approx(length, rel=1e-12)


SECTIONS = [
    {"name": name, "length": length, "outer_diameter": "0.5334 m", "inner_diameter": "0.4826 m"}
    | {"young_modulus": "210 GPa", "mass": "318 kg/m", "submerged_weight": "2714 N/m"}
    | {"drag": {"coefficient": 1.0, "diameter": "0.5334 m"}}
    for name, length in (("lower", "300 m"), ("upper", "1500 m"))
]


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(20))
def test_a_mesh_is_found_again_from_the_lengths_of_its_segments(seed, spatial):
    scene = SceneFile("rig.yaml", written(rig(seed, spatial=spatial))).resolved()
    mesh = coarsest_mesh(scene)
    found = mesh_again(scene, mesh.l0)
    np.testing.assert_array_equal(found.section, mesh.section)
    assert (found.joint, found.body) == (mesh.joint, mesh.body)
