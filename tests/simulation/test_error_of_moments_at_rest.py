"""The estimated error of the moment at rest, beside segments an eighth as long."""

import pytest
from random_rigs import rig, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.refinement import Refinement
from riserstudy.simulation.run import march

COVERED = 1.5  # true over estimated error, at most: as for angles
RIGS = range(100, 220)


def ratio(seed):
    """True error divided by the estimated error of the moment, of a rig that requests 1 %."""
    sets = {"analysis.mesh": None, "analysis.accuracy": "1 %"}
    file = SceneFile("rig.yaml", written(rig(seed, spatial=bool(seed % 2)))).with_values(sets, "test")
    refinement = Refinement(file.resolved())
    found = refinement.result()
    mesh = refinement.finest_mesh.halved().halved().halved()
    true = difference(found, march(file.resolved(), mesh, None))
    return true["moment"] / found.facts["error_estimate"]["moment"]


@pytest.mark.long
def test_a_second_order_error_at_ends_and_at_the_surface_is_not_hidden():
    """On the coarsest meshes, errors of higher order are larger, and decrease faster.

    Where segments are longer than the bending layer at a jump of the load, a few of the rigs are exceptions.
    """
    above = [seed for seed in RIGS if ratio(seed) > COVERED]
    assert len(above) <= 0.03 * len(RIGS)
