"""The mean of a cylinder output is that of the cylinder with the largest mean, as limits on means take it."""

import numpy as np
import pytest
from random_rigs import on_cylinders, rig, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

OUTPUTS = ("tensioner_stroke", "tensioner_force")


def found(tree):
    """Extremes by output, and arrays."""
    result = run(SceneFile("rig.yaml", written(tree)).resolved(), estimated=False)
    return {row["output"]: row for row in result.facts["extremes"]}, result.arrays


def with_a_failed_cylinder(tree):
    cylinders = tree["top"]["tensioners"]
    if "arrangement" in cylinders:
        cylinders["failed"] = [cylinders["count"] - 1]


@pytest.mark.parametrize("seed", range(8))
def test_at_rest_means_are_the_largest_values(seed):
    tree = rig(seed)
    tree["analysis"] = {"mesh": {"elements": 40}}
    with_a_failed_cylinder(tree)
    rows, _ = found(tree)
    for name in OUTPUTS:
        assert rows[name]["mean"] == rows[name]["largest"]


@pytest.mark.parametrize("seed", range(8))
def test_in_motion_no_cylinder_has_a_larger_mean(seed):
    """The last period is close to a steady state in which means over it and over whole periods agree."""
    tree = on_cylinders(seed, "count")
    with_a_failed_cylinder(tree)
    rows, arrays = found(tree)
    for name in OUTPUTS:
        half = arrays[name][len(arrays["time"]) // 2 :]
        largest = half.mean(axis=0).max()
        assert rows[name]["mean"] == pytest.approx(largest, abs=0.1 * np.ptp(half))
