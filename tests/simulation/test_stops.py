"""Contact with the end stops of the stroke is told, as far as outputs show it."""

import json
from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene, simulate
from riserstudy.model.stops import stops_touched

HEAVE = Path(__file__).parents[2] / "config/scenes/chang2020/heave.yaml"
STOPS = {"shortest": "-2 m", "longest": "2 m", "stop_stiffness": "50 MN/m"}
RUN = {
    "platform.heave.period": "10 s",
    "top.tensioners.stroke": STOPS,
    "analysis": {
        "duration": "30 s",
        "output": {"interval": "0.1 s"},
        "mesh": {"elements": 1},
        "step": "0.01 s",
    },
}


@pytest.fixture(scope="module")
def rig():
    return load_scene(HEAVE, **RUN).resolved().top.tensioners


def test_the_first_touch_and_the_largest_force_are_told(rig):
    reach = np.zeros((5, rig.count))
    reach[2, 0], reach[3, -1] = -2.001, 2.003
    (said,) = stops_touched(rig, reach, 0.5 * np.arange(5) + 10.0)
    assert said.startswith("stroke: touches its stop, first at t = 11 s, with at most 1.5e+05 N")
    assert "outputs 0.5 s apart from t = 10 s on" in said


def test_no_touch_no_stops_and_failed_cylinders_are_not_told_of(rig):
    time, reach = np.arange(3.0), np.full((3, rig.count), 2.0)
    assert stops_touched(rig, reach, time) == []
    beyond = reach.copy()
    beyond[:, 0] = 2.5
    assert stops_touched(rig, beyond, time)
    assert stops_touched(rig.model_copy(update={"failed": [0]}), beyond, time) == []
    assert stops_touched(rig.model_copy(update={"stroke": None}), beyond, time) == []


def test_a_touch_at_rest_is_told(rig):
    (said,) = stops_touched(rig, np.full(rig.count, -2.01))
    assert said == "stroke: touches its stop in static equilibrium, with 5e+05 N a cylinder"


@pytest.mark.parametrize("amplitude", ["0.1 m", "3 m"])
def test_a_run_tells_when_it_touches(amplitude):
    run = simulate(load_scene(HEAVE, **RUN | {"platform.heave.amplitude": amplitude}))
    told = [w for w in json.loads(run.attrs["warnings"]) if w.startswith("stroke")]
    reach = abs(run["tensioner_stroke"]).max("cylinder")
    touched = reach["time"].values[reach.values > 2.0]
    assert len(told) == (len(touched) > 0) == (amplitude == "3 m")
    if told:
        assert f"first at t = {touched[0]:.6g} s" in told[0]
