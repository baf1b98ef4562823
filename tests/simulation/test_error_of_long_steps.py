"""The error that is estimated for steps of a quarter to a fiftieth of a period, beside true ones."""

import pytest
from random_rigs import moving, written
from some_seeds import seeds

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.refine import run

FINER = 16
COVERED = 1.5  # true over estimated error, at most: as for angles


def ended(seed, steps, finer=1):
    """A rig over four periods, with outputs at all of so many steps in a period."""
    tree = moving(seed, spatial=bool(seed % 2))
    period = tree["platform"]["surge"]["period"]
    tree["analysis"] = {
        "duration": 4.0 * period,
        "step": period / steps / finer,
        "mesh": {"elements": 24},
        "output": {"interval": period / steps},
    }
    return run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=finer == 1)


@pytest.mark.parametrize("steps", [4, 7, 12, 20])
@pytest.mark.parametrize("seed", [0, 5, 7, 12, 18])
def test_the_estimated_error_is_not_below_the_true_one(seed, steps):
    given = ended(seed, steps)
    off = difference(given, ended(seed, steps, FINER))
    told = given.facts["error_estimate"]
    for name in ("displacement", "moment", "tension"):
        assert off[name] <= told[name], name


@pytest.mark.parametrize("steps", [24, 36, 50])
@pytest.mark.parametrize("seed", seeds(12, few=6))
def test_the_estimated_error_of_what_the_axial_waves_change_covers_the_true_one(seed, steps):
    """Waves along the riser are faster than the motions, and steps that resolve these miss the waves."""
    given = ended(seed, steps)
    off = difference(given, ended(seed, steps, FINER))
    told = given.facts["error_estimate"]
    for name in ("tension", "stroke", "tensioner_force"):
        if name in told:
            assert off[name] <= COVERED * told[name], name
