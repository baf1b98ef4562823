"""Estimated errors of natural frequencies against meshes eight times finer, over seeded rigs."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy import modes
from riserstudy.scene.at_rest import at_rest
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.equilibrium import settle
from riserstudy.simulation.modes import mesh_of_modes
from riserstudy.solve.modes import matrices

COUNT = 12


def frequencies(file, halvings):
    """Frequencies (Hz) on a finer mesh, by the eigenvalues of the dense inverse of the stiffness."""
    scene = file.resolved()
    mesh, d = mesh_of_modes(scene)
    for _ in range(halvings):
        mesh = mesh.halved()
    model, _ = settle(at_rest(scene), mesh, d)
    stiffness, _, mass, _ = matrices(model.programs, model.state, model.fixed)
    root = np.linalg.cholesky(mass)
    largest = np.linalg.eigvalsh(root.T @ np.linalg.solve(stiffness, root))[::-1][:COUNT]
    return 1.0 / np.sqrt(largest) / (2.0 * np.pi)


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("conductor", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_estimated_errors_of_frequencies_cover_true_ones(seed, spatial, conductor):
    tree = written(moving(seed, spatial=spatial, conductor=conductor))
    tree["analysis"] = {"mesh": {"elements": 30}}
    file = SceneFile("rig.yaml", tree)
    found = modes(file, COUNT)
    assert found["frequency_error"].attrs["units"] == "1"
    true = abs(found["frequency"].values / frequencies(file, 3) - 1.0)
    ratio = true / found["frequency_error"].values
    assert (ratio <= 2.0).all()
    assert np.median(ratio) > 0.5  # not so large that they say nothing
