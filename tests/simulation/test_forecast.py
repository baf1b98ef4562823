"""What a long run will take, told from its first periods."""

from pathlib import Path

import pytest

from riserstudy import load_scene
from riserstudy.simulation.forecast import LONG, forecast
from riserstudy.simulation.refine import run

SCENES = Path(__file__).parents[2] / "config/scenes"


def surging(duration, **changes):
    analysis = {"duration": duration, "output": {"interval": "1 s"}, "accuracy": "5 %"}
    return load_scene(SCENES / "hard/surge.yaml", analysis=analysis, **changes).resolved()


@pytest.mark.long
def test_a_forecast_is_what_the_run_then_takes():
    scene = surging("3 h")
    told = forecast(scene)
    assert told is not None
    assert told.piece * LONG < 10800.0
    facts = run(scene).facts
    # a periodic motion is the same in its first periods as later; times on a busy machine are not
    assert facts["elements"] == told.elements
    assert facts["step"] == pytest.approx(told.step, rel=0.01)
    assert told.seconds > 0.0


def test_a_mesh_of_the_scene_is_kept():
    told = forecast(surging("3 h", **{"analysis.accuracy": None, "analysis.step": "0.5 s",
                                      "analysis.mesh": {"elements": 40}}))  # fmt: skip
    assert (told.elements, told.step) == (40, pytest.approx(0.5))


def test_short_runs_and_what_changes_later_are_not_forecast():
    assert forecast(surging("60 s")) is None
    lost = {"share": 0.2, "at": "1000 s", "over": "10 s"}
    assert forecast(surging("3 h", **{"top.tension_loss": lost})) is None


def test_a_long_run_says_how_far_it_is():
    said = []
    result = run(surging("60 s"), notify=lambda what, share: said.append(what) if not share else None)
    assert len(said) == len(result.facts["refinements"])
    assert " to go" not in said[0]
    assert f"{result.facts['elements']} segments" in said[-1]
    assert " to go" in said[-1]
