"""Errors of strokes, tensioner forces, overpull and lift: estimates cover them, and limits count them."""

import copy

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.dataset.limits import checked
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.error_estimate import difference
from riserstudy.simulation.refine import run

UNITS = {
    "joint_stroke": "m",
    "tensioner_stroke": "m",
    "tensioner_force": "N",
    "overpull": "N",
    "lmrp_clearance": "m",
}
KEYS = ("stroke", "tensioner_force", "overpull", "lift")
COVERED = 1.5  # most of an error as a multiple of its estimate: waves after a disconnect are steep
ROUNDING = 1e-6  # of a largest value
CASES = [(seed, spatial, left) for seed in range(4) for spatial in (False, True) for left in (False, True)]


def rig_of(seed, spatial, left):
    """A rig in motion on few segments; with ``left``, one that disconnects."""
    tree = moving(seed, spatial=spatial, conductor=False)
    tree["analysis"]["step"] /= float(np.random.default_rng((seed, 3)).choice([1, 2, 4]))
    if not left:
        return tree
    at = 0.7 * tree["analysis"]["duration"]
    stop = {"collapse": "6 m", "stroke": "8 m", "stiffness": "5 MN/m"}
    tree["top"]["telescopic_joint"]["stop"] = stop
    tree["bottom"]["body"] = {"name": "LMRP", "mass": 7e4, "submerged_weight": "300 kN"}
    tree["disconnect"] = {"at": f"{at!r} s", "over": "0.3 s", "stack": {"stiffness": "100 MN/m"}}
    tree["analysis"] |= {"duration": at + 25.0, "step": tree["analysis"]["step"] / 3.0}
    return tree


def run_of(tree, finer=1, shorter=1):
    """A run on finer meshes by shorter steps; the scene's own has an estimate."""
    tree = copy.deepcopy(tree)
    tree["analysis"]["mesh"]["elements"] *= finer
    tree["analysis"]["step"] /= shorter
    return run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=finer == 1)


@pytest.mark.long
@pytest.mark.parametrize("seed, spatial, left", CASES)
def test_estimates_cover_errors_and_limits_count_them(seed, spatial, left):
    tree = rig_of(seed, spatial, left)
    few, fine = run_of(tree), run_of(tree, 2, 8)
    true, estimated = difference(few, fine), few.facts["error_estimate"]
    assert "stroke" in true
    assert ("lift" in true) == left
    for key in KEYS:
        assert true.get(key, 0.0) <= COVERED * estimated.get(key, 0.0) + ROUNDING
    rows = {row["output"]: row for row in fine.facts["extremes"] if row["output"] in UNITS}
    for row in few.facts["extremes"]:
        output = row["output"]
        if output not in rows:
            continue
        for side, sign in (("largest", 1.0), ("smallest", -1.0)):
            met = row[side] + 1e-9 * sign * abs(row[side])  # by the coarse run, with almost no margin
            if sign * (rows[output][side] - met) > 0.0:  # by the fine run not
                assert verdict_of(tree, few, output, side, met) != "within"


def verdict_of(tree, found, output, side, allowable):
    """The verdict of a limit on a run."""
    limit = {"output": output, side: f"{allowable!r} {UNITS[output]}", "mode": "disconnect"}
    file = SceneFile("rig.yaml", written(tree) | {"limits": [limit]})
    return checked(file, file.resolved(), found.facts)[0].verdict
