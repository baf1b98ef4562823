"""A warning says when, and how hard, a cylinder pushes; the law of the cylinder decides."""

import json
import random
from pathlib import Path

import pytest

from riserstudy import load_scene, simulate

SCENE = Path(__file__).parents[2] / "config/scenes/chang2020/heave.yaml"
ANALYSIS = {"duration": "20 s", "output": {"interval": "0.1 s"}, "mesh": {"elements": 1}, "step": "0.05 s"}


@pytest.mark.parametrize("seed", range(12))
def test_cylinders_that_push_are_reported_with_time_and_force(seed):
    random_ = random.Random(seed)
    tension, stiffness = random_.uniform(300.0, 600.0), random_.uniform(40.0, 200.0)
    amplitude = random_.uniform(1.0, 6.0)
    scene = load_scene(
        SCENE,
        **{
            "platform.heave.period": f"{random_.uniform(8.0, 16.0)} s",
            "platform.heave.amplitude": f"{amplitude} m",
            "top.tensioners.gas": None,
            "top.tensioners.damping": None,
            "top.tensioners.linear": {"tension": f"{tension} kN", "stiffness": f"{stiffness} kN/m"},
            "analysis": ANALYSIS,
        },
    )
    run = simulate(scene)
    warned = [w for w in json.loads(run.attrs["warnings"]) if "pushes" in w and "t =" in w]
    least = float(run["tensioner_force"].min())
    law = tension + stiffness * float(run["tensioner_stroke"].min())
    assert least == pytest.approx(1e3 * law, abs=2.0 * stiffness)
    assert bool(warned) == (least < 0.0)
    if warned:
        said = float(warned[0].partition("at most ")[2].partition(" kN")[0])
        assert said == pytest.approx(-least / 1e3, rel=0.02, abs=1.0)
