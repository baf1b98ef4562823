"""The mean of an angle is that of the angle with its sign, in space as in a plane."""

import copy
import json
import math

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.dataset.label import to_dataset
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run


def angles_of(tree):
    """Rows of extremes of the flex joints' angles, by name."""
    file = SceneFile("rig.yaml", written(tree))
    rows = json.loads(to_dataset(run(file.resolved(), estimated=False), file, {}).attrs["extremes"])
    return {row["output"]: row for row in rows if row["output"] in ("lfj_angle", "ufj_angle")}


def turned(tree, heading):
    """A rig in the plane of x and z, turned about the vertical, so that it is solved in space."""
    made = copy.deepcopy(tree)
    surge = made["platform"]["surge"]
    sizes = {"surge": math.cos(heading), "sway": math.sin(heading)}
    for name, size in sizes.items():
        made["platform"][name] = surge | {"amplitude": size * surge["amplitude"]}
    made["current"]["heading"] = f"{heading!r} rad"
    if place := made["top"].get("tensioners", {}).get("arrangement"):
        place["first_bearing"] += heading
    return made


@pytest.mark.parametrize("conductor", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_the_mean_of_an_angle_is_the_same_in_a_plane_and_in_space(seed, conductor):
    tree = moving(seed, spatial=False, conductor=conductor)
    tree["platform"].pop("pitch", None)
    tree["current"]["profile"]["surface_speed"] *= 0.2  # so that the angles change their sign
    flat = angles_of(tree)
    space = angles_of(turned(tree, float(np.random.default_rng(seed).uniform(0.2, 1.4))))
    assert set(flat) == set(space) == {"lfj_angle", "ufj_angle"}
    for name, row in flat.items():
        size = max(abs(row["largest"]), abs(row["smallest"]))
        assert size == pytest.approx(space[name]["largest"], rel=1e-4)
        assert abs(row["mean"]) == pytest.approx(space[name]["mean"], abs=1e-4 * size), name
