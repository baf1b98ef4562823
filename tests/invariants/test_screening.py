"""Screening for vortex-induced vibration does not depend on how a scene is written: seeded rigs."""

import copy

import numpy as np
import pytest
from changes import in_other_units, lifted, mirrored, rotated
from random_rigs import moving, rig, written
from some_seeds import seeds

from riserstudy.design import vortex_screening
from riserstudy.design.vortex_screening import Coefficients, flow_along, screening
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile
from riserstudy.simulation import modes

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

    Its modes across the plane differ from those in it by its sag alone: by up to 0.2 % in frequency. The
    bounds of an excited length move with it, and so does the mode's shape there, which lift and drag follow.
    """
    tree = moving(seed, spatial=False)
    tree["platform"].pop("pitch", None)
    turned = rotated(tree, np.random.default_rng((seed, 7)))
    one, two = (screening(SceneFile("rig.yaml", t)) for t in (written(tree), turned.tree))
    assert two.sizes["mode"] == one.sizes["mode"]
    apart = abs(two["natural_frequency"].values / one["natural_frequency"].values - 1.0)
    assert apart.max() <= 2.1e-3
    for name in NUMBERS:
        differences = abs(two[name].values / one[name].values - 1.0)
        assert (differences <= np.maximum(5e-3, 3.0 * apart)).all(), name


def on_meshes(file, monkeypatch):
    """The screenings of a file on its mesh and on four times as many segments: modes that both have."""
    mesh_of = modes.mesh_of_modes

    def halved(times):
        def made(scene):
            mesh, d = mesh_of(scene)
            for _ in range(times):
                mesh = mesh.halved()
            return mesh, d

        return made

    found = []
    for times in (0, 2):
        for module in (modes, vortex_screening):
            monkeypatch.setattr(module, "mesh_of_modes", halved(times))
        found.append(screening(file))
    common = np.intersect1d(*(each["mode"] for each in found))
    return [each.sel(mode=common) for each in found]


@pytest.mark.long
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", seeds(8, few=3))
def test_amplitudes_do_not_depend_on_the_mesh(seed, spatial, monkeypatch):
    """Lift acts up to where the bounds of the reduced velocity lie, not on whole segments."""
    tree = moving(seed, spatial=spatial, conductor=False)
    tree["analysis"] = {}  # no mesh of its own: the default one
    file = SceneFile("rig.yaml", written(tree))
    one, two = on_meshes(file, monkeypatch)
    segment, whole = np.diff(one["z"].values).max(), np.ptp(one["z"].values)
    # a bound of a short excited length moves with the frequency, too, on the scale of the whole profile
    moved = abs(one["natural_frequency"].values / two["natural_frequency"].values - 1.0) * whole
    short = (0.1 * segment + moved) / two["excited_length"].values
    for name in ("excited_length", "amplitude", "drag_factor"):
        apart = abs(one[name].values / two[name].values - 1.0)
        assert (apart <= 0.01 + short).all(), name


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_the_largest_amplitude_may_be_at_the_end_of_a_section(seed, spatial, monkeypatch):
    """Slick joints at the lower end of a buoyed riser swing most, for their diameter, where they end.

    On the mesh, this place is half a segment above the highest middle of their segments.
    """
    tree = rig(seed, spatial=spatial, conductor=False)
    draw = np.random.default_rng((seed, 3))
    lowest = tree["riser"][0]
    slick = copy.deepcopy(lowest) | {"name": "slick joints"}
    slick["length"] = lowest["length"] * draw.uniform(0.03, 0.08)
    slick["drag"]["diameter"] *= draw.uniform(0.5, 0.6)
    lowest["length"] -= slick["length"]
    tree["riser"].insert(0, slick)
    one, two = on_meshes(SceneFile("rig.yaml", written(tree)), monkeypatch)
    assert one.sizes["mode"] > 0
    long = two["excited_length"].values > 0.05 * np.ptp(two["z"].values)
    np.testing.assert_allclose(one["amplitude"][long], two["amplitude"][long], rtol=0.01)


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
    above, below = flow.heights[0] > 0.0, flow.heights[-1] < tree["water"]["seabed"]
    assert (above | below).any()
    assert (flow.drag[above | below] == 0.0).all()
    assert (flow.ends[:, above | below] == 0.0).all()
    assert flow.drag[(flow.wet > 0.0) & (flow.ends[1] > 0.0)] == pytest.approx(1.1)
    # the whole wet length, to a part of the segment at the surface, and of the one at the seabed
    wet = (flow.wet * (flow.heights[-1] - flow.heights[0])).sum()
    top, foot = min(flow.heights[-1, -1], 0.0), max(flow.heights[0, 0], tree["water"]["seabed"])
    assert wet == pytest.approx(top - foot, abs=0.1 * flow.length.max())


@pytest.mark.parametrize("seed", range(4))
def test_a_towed_riser_is_refused(seed):
    tree = rig(seed)
    tree["platform"]["cruise"] = {"speed": 0.5, "heading": "20 deg"}
    with pytest.raises(InputError, match=r"platform\.cruise"):
        screening(SceneFile("rig.yaml", written(tree)))
