"""A mean over a periodic motion does not depend on which phases the outputs or the end of a run see."""

import copy

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.dataset.limits import checked
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

ALONG = {"output": "x", "at": "upper end of section 0"}


def judged(tree, periods, interval, allowable, of=None, start=0.0):
    """A limit on the mean, by default of the upper flex joint's angle, in a run of some periods after ramps.

    ``interval``, ``start``: of outputs, in periods.
    """
    period = tree["platform"]["surge"]["period"]
    rig = copy.deepcopy(tree)
    rig["analysis"] |= {"duration": (1.0 + periods) * period, "step": period / 32, "mesh": {"elements": 16}}
    rig["analysis"]["output"] = {"interval": interval * period, "start": start * period}
    unit = "m" if of else "rad"
    limit = (of or {"output": "ufj_angle"}) | {"mean": f"{allowable!r} {unit}", "mode": "drilling"}
    file = SceneFile("rig.yaml", written(rig, unit_of={"start": "s"}) | {"limits": [limit]})
    found = run(file.resolved(), estimated=False)
    (row,) = checked(file, file.resolved(), found.facts)
    return row, found


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_a_mean_is_the_same_whatever_phases_outputs_see(seed, spatial):
    tree = moving(seed, spatial=spatial, conductor=False)
    mean = judged(tree, 4, 1 / 32, 1.0)[0].demand
    for interval in (1.0, 0.5, 0.34):
        for allowable, verdict in ((1.001 * mean, "within"), (0.999 * mean, "exceeded")):
            row, _ = judged(tree, 4, interval, allowable)
            assert row.demand == pytest.approx(mean, rel=1e-9)
            assert (row.verdict, row.missing) == (verdict, "")


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_a_part_of_a_period_does_not_bias_a_mean(seed, spatial):
    """All runs have the same steps; the windows of two to three periods start after the transients."""
    tree = moving(seed, spatial=spatial, conductor=False)
    for of in (None, ALONG):
        means = []
        for more in (0, 8, 16, 24):
            row, found = judged(tree, 14 + more / 32, 1 / 32, 1000.0, of, start=13.0)
            means.append(row.demand)
        name = of["output"] if of else "ufj_angle"
        values = found.arrays[name].reshape(len(found.arrays["time"]), -1)
        assert np.ptp(means) <= 0.001 * np.ptp(values, axis=0).max()


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_few_phases_of_a_motion_meet_no_limit(seed, spatial):
    """Values along the riser are known at outputs only, and no mean at less than a period of them."""
    tree = moving(seed, spatial=spatial, conductor=False)
    mean = judged(tree, 4, 1 / 32, 1000.0, ALONG)[0].demand
    known, _ = judged(tree, 4, 1 / 32, 1.001 * mean, ALONG)
    assert (known.verdict, known.missing) == ("within", "")
    for periods, interval, lacks, of in (
        (4, 1.0, "analysis.output.interval", ALONG),
        (4, 0.5, "analysis.output.interval", ALONG),
        (0.3, 1 / 32, "analysis.duration", ALONG),
        (0.7, 1 / 32, "analysis.duration", None),
    ):
        row, _ = judged(tree, periods, interval, 1000.0, of)
        assert row.verdict == "not evaluated"
        assert lacks in row.missing
