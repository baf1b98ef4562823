"""Advice on a scene with its own mesh is computed on this mesh, with the short segments of its layers."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.advice.ablation import fixed
from riserstudy.model.mesh import prescribed
from riserstudy.scene.load import SceneFile


@pytest.mark.parametrize("layers", [{}, {"bottom": "15 m"}, {"bottom": "9 m", "top": "20 m"}])
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_the_segments_are_those_of_the_scene(seed, spatial, layers):
    tree = written(moving(seed, spatial=spatial, conductor=False))
    tree["analysis"]["mesh"] = {"elements": 60} | ({"layers": layers} if layers else {})
    file = SceneFile("rig.yaml", tree)
    scene = file.resolved()
    own = prescribed(scene, scene.analysis.mesh.elements)
    alone, mesh = fixed(file, 1e6)
    again = prescribed(alone.resolved(), alone.resolved().analysis.mesh.elements)  # for its errors
    for one in (mesh, again):
        np.testing.assert_array_equal(one.l0, own.l0)
    assert (np.ptp(mesh.l0[: -1 - int(mesh.joint)]) > 1.0) or not layers
