"""Plots over a grid show the smallest tension of the riser, not that of the conductor below it."""

import pytest
from random_rigs import rig, written

from riserstudy import sweep
from riserstudy.figures.grid import extreme
from riserstudy.figures.heat_map import heat_map
from riserstudy.scene.load import SceneFile


@pytest.mark.parametrize("seed", range(6))
def test_the_smallest_tension_of_a_rig_is_that_of_its_riser(seed):
    """With and without a conductor, whose lower end carries no tension."""
    tree = rig(seed, spatial=bool(seed % 2), conductor=seed < 4)
    tree["limits"] = [{"output": "effective_tension", "smallest": "50 kN", "mode": "connected"}]
    axes = {"top.offset": ["0 m", "4 m"], "riser[0].drag.coefficient": [0.8, 1.2]}
    runs = sweep(SceneFile("rig.yaml", written(tree)), axes)
    smallest = extreme(runs, "effective_tension_min")
    demand = runs["demand_of_limit"].isel(limit=0)
    assert smallest.values == pytest.approx(demand.values, rel=1e-6)
    assert float(smallest.min()) > 5e4
    panel = next(a for a in heat_map(runs, ["effective_tension"]).axes if a.collections)
    drawn = 1e3 * panel.collections[0].get_array().data
    assert sorted(drawn.ravel()) == pytest.approx(sorted(demand.values.ravel()), rel=1e-6)
