"""The error of a lower flex joint is that until a disconnect, and the error of each joint is its own."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.dataset.limits import checked
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def released(seed, spatial):
    """A rig in motion that disconnects at a common step of its coarser runs, and the same rig until then."""
    tree = moving(seed, spatial=spatial, conductor=False)
    analysis = tree["analysis"]
    step = analysis["step"]
    analysis["output"]["interval"] = step
    analysis["method"] = {"rho_inf": 0.8}  # the default of a run with events is another
    at = 4.0 * step * round(0.7 * analysis["duration"] / (4.0 * step))
    analysis["duration"] = at + 8.0 * step
    held = tree | {"analysis": analysis | {"duration": at}}
    free = tree | {"disconnect": {"at": f"{at!r} s", "stack": {"stiffness": "50 MN/m"}}}
    return free, held


def facts_of(tree):
    return run(SceneFile("rig.yaml", written(tree)).resolved()).facts


def check_of_lower_joint(tree, facts, share):
    """A limit on the lower joint, this far above its largest angle, checked by this error estimate alone."""
    row = next(row for row in facts["extremes"] if row["output"] == "lfj_angle")
    size = max(abs(row["largest"]), abs(row["smallest"]))
    limit = {"output": "lfj_angle", "mode": "connected", "largest": f"{(1.0 + share) * size!r} rad"}
    file = SceneFile("rig.yaml", written(tree) | {"limits": [limit]})
    alone = {k: v for k, v in facts["error_estimate"].items() if k.endswith("angle")}
    (one,) = checked(file, file.resolved(), facts | {"error_estimate": alone})
    return one.verdict


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_what_follows_a_disconnect_is_no_error_of_the_lower_joint(seed, spatial):
    trees = released(seed, spatial)
    free, held = map(facts_of, trees)
    own = held["error_estimate"]["lfj_angle"]
    assert free["error_estimate"]["lfj_angle"] == pytest.approx(own, rel=0.02, abs=1e-6)
    for share in (0.2 * own, 3.0 * own + 1e-6):
        verdicts = {check_of_lower_joint(*of, share) for of in zip(trees, (free, held), strict=True)}
        assert len(verdicts) == 1


@pytest.mark.parametrize("seed", range(6))
def test_an_error_of_one_joint_leaves_limits_on_the_other_alone(seed):
    """Errors as large as the angle itself, of one joint after the other; angles drawn at random."""
    draw = np.random.default_rng(seed)
    tree = moving(seed, spatial=bool(seed % 2), conductor=False)
    limits = [
        {"output": joint, "mode": "connected", "largest": "1.1 rad"} for joint in ("ufj_angle", "lfj_angle")
    ]
    file = SceneFile("rig.yaml", written(tree) | {"limits": limits})
    rows = [
        {"output": limit["output"], "where": "", "largest": draw.uniform(0.5, 1.0), "smallest": 0.0}
        for limit in limits
    ]
    for k, limit in enumerate(limits):
        facts = {"extremes": rows, "error_estimate": {limit["output"]: 0.9}}
        verdicts = [one.verdict for one in checked(file, file.resolved(), facts)]
        assert verdicts[k] == "not evaluated"
        assert verdicts[1 - k] == "within"
