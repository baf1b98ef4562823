"""Tensioners that carry a hung-off riser hold it at mid-stroke, upright or inclined."""

import math

import numpy as np
import pytest
from random_rigs import rig, written

from riserstudy import simulate
from riserstudy.errors import InputError
from riserstudy.scene.load import SceneFile


def hung(seed):
    """A riser that hangs on cylinders, and how its lower end swings up and down after a small release."""
    draw = np.random.default_rng((seed, 5))
    tree = rig(seed, conductor=False)
    place = tree["top"]["tensioners"]["arrangement"]
    place |= {"ring_radius": 0.0, "deck_elevation": 20.0, "deck_radius": float(draw.uniform(0.0, 12.0))}
    tree["bottom"] = {"hold": "free"}
    tree["riser"] = tree["riser"][:1]
    tree["riser"][0]["submerged_weight"] = 1500.0
    tree["current"]["profile"]["surface_speed"] = 0.0
    tree["top"] = {"x": "platform", "z": "free", "rotation": "free"}
    tree["platform"] = {"position": {"surge": 0.0}}
    scene = written(tree)
    scene["top"]["tensioners"] = {
        "count": int(draw.integers(3, 9)),
        "mid_stroke": "riser unstretched",
        "carried": {"doubles_over": f"{draw.uniform(5, 100)} m"},
        "arrangement": written({"arrangement": place})["arrangement"],
    }
    return scene


@pytest.mark.parametrize("seed", range(12))
def test_the_riser_hangs_at_mid_stroke(seed):
    scene = hung(seed)
    scene["analysis"] = {"mesh": {"elements": 20}}
    run = simulate(SceneFile("hung", scene, {}))
    assert np.abs(run["tensioner_stroke_static"].values).max() < 1e-6


@pytest.mark.parametrize("seed", range(4))
def test_a_further_pull_is_refused_because_it_would_lift_the_riser(seed):
    scene = hung(seed)
    scene["top"]["tension"] = "100 kN"
    with pytest.raises(InputError, match=r"top\.tension: 100 kN would lift the riser"):
        SceneFile("hung", scene, {}).resolved()


@pytest.mark.parametrize("seed", range(5))
def test_the_ratio_is_that_of_the_decaying_heave(seed):
    """From the logarithmic decrement of successive strokes, of a riser that hardly stretches."""
    scene, ratio = hung(seed), 0.05
    rig_of = scene["top"]["tensioners"]
    rig_of["damping"] = {"ratio": ratio}
    scene["riser"][0] |= {"length": "60 m"}
    for drags in ("drag", "added_mass", "contents"):
        scene["riser"][0].pop(drags)
    scene.pop("current")
    reach = float(rig_of["carried"]["doubles_over"].split()[0])
    mass = float(scene["riser"][0]["mass"].split()[0])
    period = 2.0 * math.pi * math.sqrt(mass * reach / 1500.0)  # of upright cylinders
    bump = [(0.1 * k, 0.02 * math.exp(-(((0.1 * k - 0.6) / 0.15) ** 2))) for k in range(80)]
    points = [{"time": f"{t * period} s", "value": f"{v} m"} for t, v in bump]
    scene["platform"] = {"heave": {"points": points}}
    scene["analysis"] = {
        "duration": f"{7.5 * period} s",
        "step": f"{period / 400} s",
        "mesh": {"elements": 4},
        "output": {"interval": f"{period / 400} s"},
    }
    stroke = simulate(SceneFile("hung", scene, {}))["tensioner_stroke"].values[500:, 0]
    crests = [b for a, b, c in zip(stroke, stroke[1:], stroke[2:], strict=False) if a < b > c]
    decrement = math.log(crests[0] / crests[3]) / 3.0
    assert decrement / math.sqrt(4.0 * math.pi**2 + decrement**2) == pytest.approx(ratio, rel=0.03)
