"""On a user's mesh and step the allowance of a sea is that of a fine run, or it is not evaluated."""

import copy

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy.dataset.limits import demand_of
from riserstudy.design.sea_allowances import allowances
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run
from riserstudy.study.in_sea import Sea, in_sea

SEA = Sea(4.0, 10.0)
UNITS = {
    "lfj_angle": "rad",
    "bending_moment": "N*m",
    "von_mises_stress": "Pa",
    "effective_tension": "N",
    "tensioner_stroke": "m",
    "tensioner_force": "N",
}
ALONG = {"surge": "0.6 m/m", "surge_phase": "90 deg", "heave": "0.5 m/m", "heave_phase": "0 deg"}
FINER = 4
OFF = 0.08  # of the largest value: 5 % of error, and that of the estimate
CASES = [(seed, spatial) for seed in range(4) for spatial in (False, True)]


def in_waves(seed, spatial):
    """A rig below a platform that follows an irregular sea, on few segments by long or short steps."""
    tree = rig(seed, spatial=spatial, conductor=False)
    draw = np.random.default_rng((seed, spatial, 11))
    wave = {"significant_height": "4 m", "peak_period": "10 s", "peak_enhancement": 2.0}
    wave |= {"components": 20, "seed": 1}
    operators = [{"period": f"{period} s", **ALONG} for period in (1, 6, 12, 60)]
    tree["platform"]["response"] = {"operators": operators, "phases": "lead", "wave": wave, "ramp": "5 s"}
    step, elements = float(draw.choice([0.1, 0.4, 1.0])), int(draw.choice([24, 80]))
    tree["analysis"] = {"duration": 30.0, "step": step, "mesh": {"elements": elements}}
    tree["analysis"]["output"] = {"interval": 1.0}
    return tree


def finer(tree):
    tree = copy.deepcopy(tree)
    tree["analysis"]["mesh"]["elements"] *= FINER
    tree["analysis"]["step"] /= FINER
    return tree


def file_of(tree, largest):
    limits = [
        {"output": name, "largest": f"{value!r} {UNITS[name]}", "mode": "drilling"}
        for name, value in largest.items()
    ]
    return SceneFile("rig.yaml", written(tree) | {"limits": limits})


@pytest.mark.parametrize("seed, spatial", CASES)
def test_allowances_are_those_of_a_fine_run_or_not_evaluated(seed, spatial):
    tree = in_waves(seed, spatial)
    fine = file_of(finer(tree), dict.fromkeys(UNITS, 1e30))
    scene = in_sea(fine, SEA, 1).resolved()
    rows = run(scene, estimated=False).facts["extremes"]
    demands = {one.output: found[0] for one in scene.limits if (found := demand_of(scene, one, rows))}
    few, true = (allowances(file_of(one, demands), SEA, 1) for one in (tree, finer(tree)))
    known = 0
    for output, one, other in zip(demands, few, true, strict=True):
        if one.missing or other.missing:
            assert "as estimated" in one.missing + other.missing
            continue
        sides = [row[side] for row in rows if row["output"] == output for side in ("largest", "smallest")]
        assert abs(one.value - other.value) <= OFF * np.abs(sides).max(), output
        known += 1
    assert known
