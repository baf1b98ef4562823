"""A top that is held where the riser has a tension at rest, aside of the well, too."""

import math
from pathlib import Path

import pytest

from riserstudy import load_scene, simulate

SURGE = Path(__file__).parents[2] / "config/scenes/bench/s2c.yaml"


@pytest.mark.parametrize("offset", ["0 m", "5 m", "-30 m"])
def test_the_tension_at_rest_is_as_given_whatever_the_offset(offset):
    alone = {"platform": None, "current": None, "top.x": "held", "top.offset": offset}
    analysis = {"analysis": {"mesh": {"elements": 60}}}
    scene = load_scene(SURGE, **alone, **analysis)
    run = simulate(scene)
    assert run["x_static"].values[-1] == pytest.approx(float(offset.split()[0]))
    # what pulls at a free top is vertical: of the tension there its vertical part is as given
    rise, aside = (float(run[f"{name}_static"].diff("s_node")[-1]) for name in ("z", "x"))
    vertical = float(run["effective_tension_static"][-1]) * rise / math.hypot(rise, aside)
    assert vertical == pytest.approx(2275e3, rel=1e-4)
