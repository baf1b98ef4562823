"""The recipe for long records: its words make a run that costs less, with an error of its own."""

import json
import shlex
from pathlib import Path

import pytest

from riserstudy import load_scene, simulate
from riserstudy.inputs.plain_yaml import plain_yaml
from riserstudy.simulation.error_estimate import controlled
from riserstudy.simulation.recipe import recipe

RISER = Path(__file__).parents[2] / "config/scenes/design/riser.yaml"


def in_a_sea(duration, **changes):
    operators = [
        {"period": f"{period} s", "surge": "0.4 m/m", "surge_phase": "90 deg"} for period in (2, 6, 12, 40)
    ]
    wave = {
        "significant_height": "4 m",
        "peak_period": "10 s",
        "peak_enhancement": 2,
        "components": 60,
        "seed": 1,
    }
    response = {"operators": operators, "phases": "lead", "wave": wave, "ramp": "20 s"}
    values = {
        "top.x": "platform",
        "top.z": "platform",
        "platform": {"response": response},
        "analysis": {"duration": f"{duration} s", "output": {"interval": "1 s"}},
    }
    return load_scene(RISER, **(values | changes))


def given(words):
    """The values that a user sets by the words of a recipe."""
    parts = shlex.split(words)
    assert parts[::2] == ["--set"] * (len(parts) // 2)
    pairs = (part.split("=", 1) for part in parts[1::2])
    return {path: plain_yaml(value, path) for path, value in pairs}


@pytest.mark.long
def test_the_words_of_a_recipe_make_a_run_with_an_error_like_that_of_its_piece():
    found = recipe(in_a_sea(1800).resolved())
    assert found is not None
    own = simulate(in_a_sea(1800).with_values(given(found.words), "recipe"), progress=False)
    estimate = json.loads(own.attrs["error_estimate"])
    assert own.attrs["step"] == pytest.approx(found.step, rel=0.01)
    worst, on_the_piece = (max(controlled(one).values()) for one in (estimate, found.error))
    assert 0.0 < worst < 3.0 * on_the_piece + 0.01
    assert worst < 0.15


def test_a_recipe_is_for_long_irregular_records_without_a_mesh():
    assert recipe(in_a_sea(900).resolved()) is None
    own = {"analysis.mesh": {"elements": 20}, "analysis.step": "0.5 s"}
    assert recipe(in_a_sea(3000).with_values(own, "test").resolved()) is None
    assert recipe(load_scene(RISER).resolved()) is None
    rough = in_a_sea(3000).with_values({"analysis.accuracy": "5 %"}, "test").resolved()
    assert recipe(rough) is None
