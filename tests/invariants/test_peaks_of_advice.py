"""Peaks by which `advise` measures changes do not depend on the direction of the axes: rigs in space."""

import numpy as np
import pytest
from changes import rotated
from random_rigs import moving, written

from riserstudy.advice.ablation import fixed, peaks
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.run import single


@pytest.mark.parametrize("still", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_peaks_do_not_depend_on_the_direction_of_the_axes(seed, still):
    tree = moving(seed, spatial=True, conductor=False)
    if still:
        tree["analysis"] = {"mesh": tree["analysis"]["mesh"]}
    found = []
    for one in (written(tree), rotated(tree, np.random.default_rng(seed)).tree):
        file, mesh = fixed(SceneFile("rig.yaml", one), 1e9)
        scene = file.resolved()
        found.append(peaks(single(scene, mesh, scene.analysis.step)))
    assert found[1] == pytest.approx(found[0], rel=1e-8 if still else 1e-3)
