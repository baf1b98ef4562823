"""On a user's mesh and step the allowance of a sea is that of a fine run, or it is not evaluated."""

import numpy as np
import pytest
from rigs_in_waves import finer, in_waves, limited

from riserstudy.dataset.limits import demand_of
from riserstudy.design.sea_allowances import allowances
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
OFF = 0.08  # of the largest value: 5 % of error, and that of the estimate
CASES = [(seed, spatial) for seed in range(4) for spatial in (False, True)]


def of_seed(seed, spatial):
    """A rig in waves, on few segments by long or short steps."""
    return in_waves(seed, spatial, 11, "4 m", 20, 30.0, [0.1, 0.4, 1.0], [24, 80])


@pytest.mark.parametrize("seed, spatial", CASES)
def test_allowances_are_those_of_a_fine_run_or_not_evaluated(seed, spatial):
    tree = of_seed(seed, spatial)
    fine = limited(finer(tree), dict.fromkeys(UNITS, 1e30), UNITS)
    scene = in_sea(fine, SEA, 1).resolved()
    rows = run(scene, estimated=False).facts["extremes"]
    demands = {one.output: found[0] for one in scene.limits if (found := demand_of(scene, one, rows))}
    few, true = (allowances(limited(one, demands, UNITS), SEA, 1) for one in (tree, finer(tree)))
    known = 0
    for output, one, other in zip(demands, few, true, strict=True):
        if one.missing or other.missing:
            assert "as estimated" in one.missing + other.missing
            continue
        sides = [row[side] for row in rows if row["output"] == output for side in ("largest", "smallest")]
        assert abs(one.value - other.value) <= OFF * np.abs(sides).max(), output
        known += 1
    assert known
