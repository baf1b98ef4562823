"""A mean of outputs that see few phases of a motion meets no limit that the mean over all phases exceeds."""

import copy

import pytest
from random_rigs import moving, written

from riserstudy.dataset.limits import checked
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def judged(tree, periods, interval, allowable):
    """The limit on the mean of the upper flex joint's angle in a run of some periods after the ramps."""
    period = tree["platform"]["surge"]["period"]
    rig = copy.deepcopy(tree)
    rig["analysis"] |= {"duration": (1.0 + periods) * period, "step": period / 32, "mesh": {"elements": 16}}
    rig["analysis"]["output"] = {"interval": interval * period}
    limit = {"output": "ufj_angle", "mean": f"{allowable!r} rad", "mode": "drilling"}
    file = SceneFile("rig.yaml", written(rig) | {"limits": [limit]})
    (row,) = checked(file, file.resolved(), run(file.resolved(), estimated=False).facts)
    return row


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_few_phases_of_a_motion_meet_no_limit(seed, spatial):
    tree = moving(seed, spatial=spatial, conductor=False)
    mean = judged(tree, 4, 1 / 32, 1.0).demand
    known = judged(tree, 4, 1 / 32, 1.001 * mean)
    assert (known.verdict, known.missing) == ("within", "")
    for periods, interval, lacks in (
        (4, 1.0, "analysis.output.interval"),
        (4, 0.5, "analysis.output.interval"),
        (0.3, 1 / 32, "analysis.duration"),
        (0.7, 1 / 32, "analysis.duration"),
    ):
        row = judged(tree, periods, interval, 0.999 * mean)
        assert row.verdict in ("not evaluated", "exceeded")
        assert lacks in row.missing
