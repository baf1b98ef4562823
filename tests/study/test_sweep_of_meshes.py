"""A grid whose points choose meshes of their own: each is its run, in plane and space, and reruns as such."""

import numpy as np
import pytest
from random_rigs import moving, written
from scipy.interpolate import CubicSpline

from riserstudy import sweep
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run
from riserstudy.study.repeat_point import rerun

AXIS = "platform.position.surge"


def rig_of(seed, spatial):
    """A moving rig that chooses its mesh."""
    tree = moving(seed, spatial=spatial, conductor=False)
    output = tree["analysis"]["output"]
    tree["analysis"] = {"duration": 12.0, "accuracy": "20 %", "output": output}
    return SceneFile("rig.yaml", written(tree))


@pytest.mark.parametrize("keep", [None, ["x", "ufj_angle"], ["bending_moment"]])
@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", [0, 4, 8, 10])
def test_points_on_other_meshes_are_their_runs(monkeypatch, tmp_path, seed, spatial, keep):
    monkeypatch.setenv("RISERSTUDY_CACHE", str(tmp_path))
    file = rig_of(seed, spatial)
    depth = -float(file.tree["water"]["seabed"].split()[0])
    offsets = [0.0, round(0.06 * depth, 1)]
    runs = sweep(file, {AXIS: [f"{offset} m" for offset in offsets]}, keep=keep)
    assert runs["elements"][0] != runs["elements"][1]
    for offset in offsets:
        again = rerun(runs, {"platform_position_surge": str(offset)})
        assert max(again.changes.values()) < 1e-9, again.changes
        own = run(file.with_values({AXIS: f"{offset} m"}, "own").resolved()).arrays
        mine = runs.sel(platform_position_surge=offset)
        nodes = own["s_node"]
        if "x" in mine:
            there = CubicSpline(mine["s"].values, mine["x"][-1].values)(
                nodes
            )  # a riser is curved between nodes
            assert there == pytest.approx(own["x"][-1], abs=2e-3 * np.ptp(own["x"][-1]))
        for name in [name for name in mine.data_vars if mine[name].dims == ("s_node",)]:
            far = abs(mine["s_node"].values[:, None] - nodes).min(axis=1)
            common = mine[name].values[far < 1e-6]
            mask = abs(nodes[:, None] - mine["s_node"].values).min(axis=1) < 1e-6
            assert np.array_equal(common, own[name][mask], equal_nan=True), name
