"""An effect that changes the tension below the tensioners is needed, also if the top does not notice it."""

import pytest
from random_rigs import rig, written

from riserstudy.advice.ablation import ablate, laid
from riserstudy.advice.changes import fitting
from riserstudy.advice.recommendations import accuracy_of, row
from riserstudy.effects.catalogue import changes
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.run import single

WEIGHTS = ("without weight", "without contents")
REMOVABLE = ("removable", "removable, no time saved")


def offset(seed):
    """A rig at an offset of 3 % of its depth, which governs its displacements and its moments."""
    tree = rig(seed, conductor=False)
    tree["platform"]["position"]["surge"] = -0.03 * tree["water"]["seabed"]
    tree["analysis"] = {"accuracy": "5 %"}
    return SceneFile("rig.yaml", written(tree))


@pytest.mark.parametrize("seed", [3, 11, 12, 17, 22, 30, 41, 52])
def test_the_smallest_tension_of_a_riser_without_a_removable_effect_is_as_before(seed):
    file = offset(seed)
    base = ablate(file, 1, 1e5, left_out={change.label for change in changes()} - {*WEIGHTS})
    limits = accuracy_of(file.resolved())
    others = {change.label: other for change, other in fitting(base.file)}
    below = slice(None, -1)  # without the telescopic joint, which slides without force
    whole = single(base.file.resolved(), base.mesh, None).arrays["effective_tension_static"][below]
    assert len(base.changed) == len(WEIGHTS)
    for changed in base.changed:
        scene = others[changed.change.label].resolved()
        least = single(scene, laid(scene, base.mesh), None).arrays["effective_tension_static"][below].min()
        if row(base, changed, limits).verdict in REMOVABLE:
            assert abs(least - whole.min()) <= limits[2] * whole[-1], changed.change.label
