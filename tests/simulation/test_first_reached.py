"""When a limit is first reached: a run that ends before is within it, one that ends after is not."""

import json
from types import SimpleNamespace

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy import simulate
from riserstudy.scene.limits import Limit
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.first_reached import first_reached

OUTPUTS = ("lfj_angle", "bending_moment", "von_mises_stress", "tensioner_stroke", "joint_stroke")
DURATION, INTERVAL = 60.0, 0.5
TIMES = np.arange(0.0, 101.0)


def adrift(seed, limits, duration):
    """A rig on a vessel that waves push off the well."""
    tree = rig(seed, spatial=False, conductor=False)
    del tree["platform"]
    tree["top"]["x"], tree["top"]["z"] = "vessel", "held"
    tree["vessel"] = {"mass": 4.5e7, "hull_drag": "400000 N*s^2/m^2", "wave_drift": {"force": "2 MN"}}
    tree["analysis"] = {
        "duration": duration,
        "step": 0.25,
        "mesh": {"elements": 60},
        "output": {"interval": INTERVAL},
    }
    return SceneFile("adrift.yaml", written(tree) | {"limits": limits})


def limit(output, value):
    unit = {"lfj_angle": "rad", "bending_moment": "N*m", "von_mises_stress": "Pa"}.get(output, "m")
    return {"output": output, "largest": f"{value!r} {unit}", "mode": "disconnect"}


def verdicts(file):
    run = simulate(file, progress=False)
    return [row["verdict"] for row in json.loads(run.attrs["limits"])], run


@pytest.mark.parametrize("seed", range(4))
def test_a_run_that_ends_before_a_limit_is_reached_is_within_it_and_one_that_ends_after_is_not(seed):
    whole = verdicts(adrift(seed, [limit(name, 1e12) for name in OUTPUTS], DURATION))[1]
    rows = json.loads(whole.attrs["limits"])
    assert json.loads(whole.attrs["limits_reached"]) == ["never"] * len(OUTPUTS)
    limits = [limit(name, 0.6 * row["demand"]) for name, row in zip(OUTPUTS, rows, strict=True)]
    run = verdicts(adrift(seed, limits, DURATION))[1]
    reached = 0
    for k, time in enumerate(json.loads(run.attrs["limits_reached"])):
        assert time != "never"
        if not 2.0 < time < DURATION - 2.0:
            continue  # exceeded at rest
        before, after = (
            verdicts(adrift(seed, limits, round(2.0 * time) / 2.0 + shift))[1] for shift in (-1.0, 1.0)
        )
        row, later = (json.loads(one.attrs["limits"])[k] for one in (before, after))
        assert row["demand"] < row["allowable"]
        assert later["verdict"] == "exceeded"
        if row["verdict"] != "within":  # this near to it an output may be by its own error
            assert row["verdict"] == "not evaluated"
            named = "the lower flex joint angle" if OUTPUTS[k] == "lfj_angle" else OUTPUTS[k]
            assert row["missing"].startswith(f"an error of {named}")
        reached += 1
    assert reached, "no limit of this scene is reached on the way: it tests nothing"


@pytest.mark.parametrize(
    "stroke, reached",
    [(0.1 * TIMES, 50.0), (0.0 * TIMES, "never"), (np.nan * TIMES, "unknown")],
    ids=["reached", "not reached", "without values"],
)
def test_a_history_without_values_does_not_say_never(stroke, reached):
    limits = [Limit.model_validate({"output": "stroke", "largest": "5 m", "mode": "connected"})]
    arrays = {"time": TIMES, "stroke": stroke}
    (found,) = first_reached(SimpleNamespace(limits=limits, connected_until=np.inf), None, arrays, {}, {})
    assert found.time == (reached if isinstance(reached, str) else pytest.approx(reached))
