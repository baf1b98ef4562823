"""Shapes of modes on stations stand where their nodes are, on meshes that are finer at one end."""

from pathlib import Path

import numpy as np
import pytest

from riserstudy.scene.load import read_scene
from riserstudy.simulation.labelled_modes import modes
from riserstudy.study.modes import STATIONS, modes_result

SYSTEM = Path(__file__).parents[2] / "config/scenes/liu2020/system.yaml"


@pytest.mark.parametrize("end", ["bottom", "top"])
def test_a_shape_has_the_values_of_its_nodes_at_their_shares_of_the_length(end):
    mesh = {"elements": 60, "layers": {end: "4 m"}}
    file = read_scene(SYSTEM).with_values({"analysis": {"mesh": mesh}}, "test")
    found, shapes = modes(file, 3), modes_result(file, 3).arrays["mode_shape_x"]
    share = found["s"].values / float(found["s"][-1])
    assert np.abs(share + share[::-1] - 1.0).max() > 0.05  # finer at one end
    for node, station in enumerate(np.searchsorted(np.linspace(0.0, 1.0, STATIONS), share, "right") - 1):
        if 0 < node < len(share) - 1:
            near = shapes[:, station : station + 2]
            value = found["x"].values[:, node]
            # between both stations, by what a shape changes within a segment
            room = np.abs(np.diff(found["x"].values[:, node - 1 : node + 2], axis=1)).max(axis=1)
            assert (value <= near.max(axis=1) + 0.5 * room).all()
            assert (value >= near.min(axis=1) - 0.5 * room).all()
