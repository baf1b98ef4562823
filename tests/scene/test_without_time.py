"""A static run names every line of its scene that only a dynamic run uses, and is not changed by it."""

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy.records.warning import sentences
from riserstudy.scene.load import SceneFile
from riserstudy.simulation.refine import run

WAVE = {"above_mean_level": "none", "amplitude": "2 m", "period": "9 s", "ramp": "9 s"}
IN_TIME = ("surge", "sway", "heave", "pitch", "cruise")


def resolved(tree):
    return SceneFile("rig.yaml", written(tree), {}).resolved()


def no_effect(result):
    return [text for text in sentences(result.facts["warnings"]) if "no effect in a static run" in text]


@pytest.mark.parametrize("seed", range(6))
def test_a_static_run_names_what_has_no_effect_on_it(seed):
    tree = moving(seed, spatial=bool(seed % 2))
    draw = np.random.default_rng((seed, 2))
    tree["analysis"] = {"mesh": {"elements": 20}}
    lines = [f"platform.{name}" for name in IN_TIME if name in tree["platform"]]
    if draw.random() < 0.5:
        tree["platform"]["cruise"] = {"speed": 0.5, "ramp": 20.0}
        lines.append("platform.cruise")
    if draw.random() < 0.5:
        tree["current"]["ramp"] = 20.0
        lines.append("current.ramp")
    if draw.random() < 0.5:
        tree["wave"] = WAVE
        lines.append("wave")
    result = run(resolved(tree))
    (warning,) = no_effect(result)
    assert warning.split(": ")[0].split(", ") == lines

    for name in IN_TIME:
        tree["platform"].pop(name, None)
    tree["current"].pop("ramp", None)
    tree.pop("wave", None)
    still = run(resolved(tree))
    assert no_effect(still) == []
    for name, values in still.arrays.items():
        np.testing.assert_allclose(result.arrays[name], values, rtol=1e-9, atol=1e-9, err_msg=name)


@pytest.mark.parametrize("seed", range(3))
def test_a_dynamic_run_has_no_such_line(seed):
    tree = moving(seed)
    tree["analysis"]["duration"] = 4.0 * tree["analysis"]["step"]
    assert no_effect(run(resolved(tree), estimated=False)) == []


@pytest.mark.parametrize("line", ["wind", "wave_drift", "thrusters"])
def test_forces_on_a_vessel_have_no_effect_on_a_static_run(line):
    tree = moving(0, spatial=False)
    forces = {
        "wind": {"drag": "1 kN*s^2/m^2", "speed": "20 m/s"},
        "wave_drift": {"force": "1 MN"},
        "thrusters": {"gain": "1 kN/m", "command": "40 m"},
    }
    tree["platform"] = {}
    tree["top"] |= {"x": "vessel", "offset": 10.0}
    tree["vessel"] = {"mass": 5e7, line: forces[line]}
    tree["analysis"] = {"mesh": {"elements": 20}}
    (warning,) = no_effect(run(resolved(tree)))
    assert warning.startswith(f"vessel.{line}: ")
