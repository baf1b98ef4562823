"""A step of over a quarter of a period is refused: with doubled steps, a run sees zeros of motion alone."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.errors import SimulationError
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

WAVE = {"height": 3.0, "above_mean_level": "none", "ramp": 30.0}


def rig(seed, spatial):
    """A rig in motion, and the shortest of its periods (s): of the platform, or of a regular wave."""
    tree = moving(seed, spatial=spatial, conductor=False)
    period = tree["platform"]["surge"]["period"]
    if seed % 2:
        period *= float(np.random.default_rng(seed).uniform(0.3, 0.9))
        tree["wave"] = WAVE | {"period": period}
    return tree, period


def ended(tree, step):
    tree["analysis"] = tree["analysis"] | {"step": step, "mesh": {"elements": 20}}
    file = SceneFile("rig.yaml", written(tree, unit_of={"height": "m"}))
    return run(file.resolved(), estimated=False)


@pytest.mark.parametrize("share", [0.26, 0.4, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_more_than_a_quarter_of_a_period_is_refused(seed, spatial, share):
    tree, period = rig(seed, spatial)
    with pytest.raises(SimulationError, match=r"analysis\.step: .* is more than a quarter of"):
        ended(tree, share * period)


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(2))
def test_less_is_accepted_and_so_is_a_motion_without_amplitude(seed, spatial):
    tree, period = rig(seed, spatial)
    tree["platform"]["pitch"] = {"amplitude": 0.0, "period": 0.1 * period}
    assert ended(tree, period / 4.0).facts["steps"] > 5
