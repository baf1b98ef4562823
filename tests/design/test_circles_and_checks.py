"""A watch circle and a check answer alike: what the one cannot evaluate is not safe for the other."""

import json

import pytest
from random_rigs import rig, written

from riserstudy import simulate
from riserstudy.design.watch_circles_of_run import Times, circles
from riserstudy.scene.load import SceneFile

OUTPUTS = {"lfj_angle": "rad", "bending_moment": "N*m", "effective_tension": "N"}


def towed(seed):
    """A rig below a platform that drives off, on few segments."""
    tree = rig(seed, spatial=bool(seed % 2), conductor=False)
    tree["platform"]["cruise"] = {"speed": 0.3, "ramp": 20.0}
    analysis = {"duration": 60.0, "step": 0.5, "mesh": {"elements": 24}}
    tree["analysis"] = analysis | {"output": {"interval": 1.0}}
    return tree


def run_with(tree, above):
    """A run whose limits are above the largest values by a share; the limits are found by a first run."""
    limits = [
        {"output": name, "largest": f"{above[k]!r} {unit}", "mode": "disconnect"}
        for k, (name, unit) in enumerate(OUTPUTS.items())
    ]
    file = SceneFile("rig.yaml", written(tree) | {"limits": limits})
    return file.resolved(), simulate(file, progress=False)


@pytest.mark.parametrize("seed", range(4))
def test_a_limit_that_is_not_evaluated_has_no_circle(seed):
    tree = towed(seed)
    _, free = run_with(tree, [1e9] * len(OUTPUTS))
    demands = [row["demand"] for row in json.loads(free.attrs["limits"])]
    scene, found = run_with(tree, [1.0001 * demand for demand in demands])
    verdicts = [row["verdict"] for row in json.loads(found.attrs["limits"])]
    table = circles(scene, found, Times(5.0, 5.0), ["disconnect"])
    assert "not evaluated" in verdicts
    for row, verdict in zip(table.table.rows, verdicts, strict=False):
        told = str(row[-1]).startswith("not evaluated: ")
        assert told == (verdict == "not evaluated")
    assert table.missing
    assert "that are evaluated" in table.table.rows[-1][0]


@pytest.mark.parametrize("seed", range(4))
def test_a_mode_of_which_no_limit_is_evaluated_has_no_circle(seed):
    """Means have no time at which they are reached: their mode is not one of which no limit is reached."""
    angles = ("lfj_angle", "ufj_angle")
    means = [{"output": name, "mean": "1e9 rad", "mode": "drilling"} for name in angles]
    largest = {"output": "effective_tension", "largest": "1e12 N", "mode": "disconnect"}
    limits = [*means[: 1 + seed // 2], largest]
    file = SceneFile("rig.yaml", written(towed(seed)) | {"limits": limits})
    table = circles(
        file.resolved(), simulate(file, progress=False), Times(5.0, 5.0), ["drilling", "disconnect"]
    )
    whole = {row[0].partition(":")[0]: row for row in table.table.rows if "first of all" in str(row[0])}
    assert whole["drilling"][1:5] == [None] * 4
    assert str(whole["drilling"][-1]).startswith("not evaluated")
    assert not str(whole["disconnect"][-1]).startswith("not evaluated")
