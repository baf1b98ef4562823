"""A top that is held where the riser has a tension at rest: aside, under a body, however the run begins."""

import math
from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene, simulate
from riserstudy.scene.load import SceneFile

SURGE = Path(__file__).parents[2] / "config/scenes/bench/s2c.yaml"


@pytest.mark.parametrize("offset", ["0 m", "5 m", "-30 m"])
def test_the_tension_at_rest_is_as_given_whatever_the_offset(offset):
    alone = {"platform": None, "current": None, "top.x": "held", "top.offset": offset}
    analysis = {"analysis": {"mesh": {"elements": 60}}}
    scene = load_scene(SURGE, **alone, **analysis)
    run = simulate(scene)
    assert run["x_static"].values[-1] == pytest.approx(float(offset.split()[0]))
    assert vertical(run) == pytest.approx(2275e3, rel=1e-4)


def vertical(run):
    """Vertical component of the pull on the riser's top at rest (N): a free top is pulled vertically."""
    sides = [f"{name}_static" for name in "xyz" if f"{name}_static" in run]
    chord = [float(run[name].diff("s_node")[-1]) for name in sides]
    return float(run["effective_tension_static"][-1]) * chord[-1] / math.hypot(*chord)


def drawn(seed):
    """A riser in a current, held at a tension on a displaced platform, with a body at its top."""
    draw = np.random.default_rng((seed, 44))
    pipe = {
        "name": "riser",
        "length": f"{draw.uniform(300, 900)} m",
        "outer_diameter": "0.53 m",
        "inner_diameter": "0.49 m",
        "young_modulus": "207 GPa",
        "mass": "500 kg/m",
        "submerged_weight": f"{draw.uniform(500, 1500)} N/m",
        "drag": {"coefficient": 1.0, "diameter": "0.6 m"},
        "added_mass": {"coefficient": 1.0, "diameter": "0.6 m"},
    }
    tilts = {name: f"{draw.uniform(-4, 4)} deg" for name in (("roll", "pitch") if seed % 2 else ("pitch",))}
    aside = {"sway": "4 m"} if seed % 2 else {}
    length = float(pipe["length"].split()[0])
    tree = {
        "title": "held",
        "gravity": "9.81 m/s^2",
        "water": {"density": "1025 kg/m^3", "surface": f"{length - 20} m", "seabed": "-10 m"},
        "riser": [pipe],
        "bottom": {"hold": "wellhead", "elevation": "0 m", "rotation": "free"},
        "top": {
            "x": "platform",
            "z": str(draw.choice(["platform", "held"])),
            "offset": f"{draw.uniform(-5, 5)} m",
            "held_at_tension": f"{draw.uniform(2.5, 4.0)} MN",
            "rotation": "free",
            "body": {"name": "ring", "mass": "20 t", "submerged_weight": f"{draw.uniform(0, 500)} kN"},
        },
        "current": {"profile": {"shape": "uniform", "surface_speed": f"{draw.uniform(0.1, 0.3)} m/s"}},
        "platform": {
            "position": {"surge": f"{draw.uniform(-4, 4)} m"} | aside | tilts,
            "centre_of_rotation": {"x": "15 m", "y": "-10 m", "elevation": f"{length + 40} m"},
        },
        "analysis": {"mesh": {"elements": 40}},
    }
    if tree["top"]["z"] == "platform":
        tree["platform"]["position"]["heave"] = f"{draw.uniform(-2, 2)} m"
    return tree, float(tree["top"]["held_at_tension"].split()[0]) * 1e6


@pytest.mark.parametrize("seed", range(10))
def test_the_tension_is_as_given_on_a_displaced_platform_and_under_a_body(seed):
    """In plane and space. The rest of the tilted arm's second order is below 1e-3 of the tension."""
    tree, pull = drawn(seed)
    run = simulate(SceneFile("held", tree, {}))
    assert vertical(run) == pytest.approx(pull, rel=1e-3)


@pytest.mark.parametrize("seed", range(6))
def test_the_height_does_not_depend_on_how_the_run_begins(seed):
    """With a current that starts or increases later, and with a platform that starts displaced."""
    tree, _ = drawn(seed)
    tree["analysis"] |= {"duration": "2 s", "step": "0.1 s", "output": {"interval": "1 s"}}
    heights = []
    for start, ramp, phase in (
        ("equilibrium", None, None),
        ("undeflected", None, None),
        ("equilibrium", "60 s", None),
        ("equilibrium", None, "90 deg"),
    ):
        tree["analysis"]["start"] = start
        tree["current"].pop("ramp", None)
        tree["platform"].pop("surge", None)
        if ramp:
            tree["current"]["ramp"] = ramp
        if phase:
            tree["platform"]["surge"] = {"amplitude": "6 m", "period": "60 s", "phase": phase}
        run = simulate(SceneFile("held", tree, {}))
        heights += [float(run["z"][0, -1])]
    assert heights == pytest.approx(4 * [heights[0]], abs=1e-6)
