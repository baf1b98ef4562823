"""What is no result is refused: a riser folded over a segment, an error larger than the result itself."""

import json

import numpy as np
import pytest
from random_rigs import moving, rig, written

from riserstudy import load_scene, simulate
from riserstudy.errors import SimulationError
from riserstudy.scene.load import SceneFile

FOLDS = """
title: a platform aside, across the plane that a first shape is drawn in
water: {density: 1000 kg/m^3, surface: 960 m, seabed: -172 m}
riser:
  - {name: a, length: 253 m, outer_diameter: 0.883 m, inner_diameter: 0.849 m, young_modulus: 186 GPa,
     submerged_weight: 3980 N/m}
  - {name: b, length: 885 m, outer_diameter: 0.64 m, inner_diameter: 0.611 m, young_modulus: 215 GPa,
     submerged_weight: 1830 N/m}
bottom: {hold: wellhead, elevation: -170 m, rotation: free}
top:
  {x: platform, z: platform, elevation: 977 m, rotation: free,
   telescopic_joint: {length: 8.82 m, bending_stiffness: 4.42e8 N*m^2, tension: 4.92 MN}}
platform: {position: {sway: -34.4 m}}
analysis: {mesh: {elements: 36}}
"""


@pytest.mark.parametrize("elements", [24, 30, 36, 42, 50])
def test_a_platform_aside_across_the_first_shape_has_the_same_riser_on_every_mesh(tmp_path, elements):
    file = tmp_path / "aside.yaml"
    file.write_text(FOLDS)
    run = simulate(load_scene(file, **{"analysis.mesh.elements": elements}), progress=False)
    assert float(run["joint_stroke"]) == pytest.approx(0.042, abs=0.01)  # m; 60 m where it folds
    assert float(run["effective_tension"].min()) > 2e6


@pytest.mark.parametrize("seed", range(20))
def test_no_riser_far_aside_is_folded(seed):
    """Over random rigs, meshes and directions: it turns by less than a right angle, or is refused."""
    draw = np.random.default_rng(seed)
    tree = rig(seed, spatial=True, conductor=False)
    length = sum(section["length"] for section in tree["riser"])
    for name in ("surge", "sway"):
        tree["platform"]["position"][name] = float(draw.uniform(-0.08, 0.08)) * length
    tree["analysis"] = {"mesh": {"elements": int(draw.integers(10, 60))}}
    try:
        run = simulate(SceneFile("rig.yaml", written(tree)), progress=False)
    except SimulationError:
        return
    points = np.stack([run[axis].values for axis in "xyz"])
    way = np.diff(points, axis=1)
    assert ((way[:, 1:] * way[:, :-1]).sum(axis=0) > 0.0).all()


def test_nothing_is_within_a_limit_by_a_result_that_is_smaller_than_its_error():
    tree = moving(1, spatial=False, conductor=False)
    tree["analysis"] |= {"mesh": {"elements": 2}, "step": 2.4, "output": {"interval": 3.0}}
    tree["analysis"]["duration"] = 30.0
    limits = [{"output": "bending_moment", "largest": "1e9 N*m", "mode": "drilling"}]
    run = simulate(SceneFile("rig.yaml", written(tree) | {"limits": limits}), progress=False)
    assert "estimated error is larger than the result" in run.attrs["warnings"]
    (row,) = json.loads(run.attrs["limits"])
    assert row["verdict"] == "not evaluated"
    assert "estimated error" in row["missing"]
