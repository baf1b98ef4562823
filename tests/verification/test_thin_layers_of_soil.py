"""Layers of soil that are thinner than a segment hold a conductor as on a fine mesh: seeded rigs at rest."""

import numpy as np
import pytest
from random_rigs import FOOT, rig, written

from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

LIKE = 0.1  # relative difference of the largest displacement in the soil; 330 to 580 % without the layer
CURVE = ((0.005, 0.3), (0.02, 0.7), (0.1, 1.0))  # displacement (m), and share of the ultimate resistance


def with_a_hard_layer(seed, *, spatial):
    """A rig, 10 m off its well, on a conductor in soft soil with one hard layer of 0.1 to 0.4 m."""
    draw = np.random.default_rng((seed, 3))
    tree = written(rig(seed, spatial=spatial, conductor=True))
    tree["platform"]["position"]["surge"] = "10 m"
    top, thick, step = float(draw.uniform(1.0, 4.0)), float(draw.uniform(0.1, 0.4)), 0.001
    rows = [(0.0, 1e3), (top, 2e3), (top + step, 4e6), (top + thick, 4e6), (top + thick + step, 8e3)]
    table = [
        {"depth": f"{depth} m", "displacement": f"{y} m", "resistance": f"{share * most} N/m"}
        for depth, most in [*rows, (FOOT, 2e5)]
        for y, share in CURVE
    ]
    tree["soil"] = {"mudline": tree["soil"]["mudline"], "resistance": {"table": table}}
    return tree


def aside(tree, analysis):
    """Largest displacement in the soil at rest (m)."""
    found = run(SceneFile("rig.yaml", tree | {"analysis": analysis}, {}).resolved()).arrays
    inside = found["s_node"] <= FOOT
    x, y = found["x_static"], found.get("y_static", np.zeros(len(inside)))
    return float(np.hypot(x, y)[inside].max())


@pytest.mark.parametrize("spatial", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_a_mesh_that_is_chosen_does_not_miss_a_thin_layer(seed, spatial):
    tree = with_a_hard_layer(seed, spatial=spatial)
    chosen = aside(tree, {"accuracy": "1 %"})
    assert chosen == pytest.approx(aside(tree, {"mesh": {"elements": 8000}}), rel=LIKE)
