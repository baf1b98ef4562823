"""An output interval that a refusal advises is accepted."""

import re

import numpy as np
import pytest
from fatigued_rigs import WELD, fatigued, listed
from random_rigs import moving, written

from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(8))
def test_the_advised_interval_is_accepted(seed, spatial):
    tree = fatigued(moving(seed, spatial=spatial), WELD)
    period = float(np.random.default_rng(seed).uniform(5.0, 20.0))
    for motions in tree["platform"].values():
        for motion in motions if isinstance(motions, list) else [motions]:
            if isinstance(motion, dict) and "period" in motion:
                motion["period"] = period
    assert listed(tree["platform"]["surge"])["period"] == period
    file = SceneFile("rig.yaml", written(tree))
    with pytest.raises(InputError, match="outputs miss peaks of stress") as refused:
        file.with_values({"analysis.output.interval": f"{period / 5.0} s"}, "test").resolved()
    advised = re.search(r"give at most (\S+ s)", str(refused.value))[1]
    accepted = file.with_values({"analysis.output.interval": advised}, "test").resolved()
    assert accepted.analysis.output.interval == pytest.approx(period / 8.0, rel=0.01)
