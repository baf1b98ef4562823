"""Contact with the end stops of the stroke is told, by all steps where they are known."""

import json
from pathlib import Path

import numpy as np
import pytest

from riserstudy import load_scene, simulate
from riserstudy.model.stops import stops_touched
from riserstudy.records.warning import sentences
from riserstudy.scene.tensioners import Failing

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
    (said,) = sentences(stops_touched(rig, reach, 0.5 * np.arange(5) + 10.0))
    assert said.startswith(
        "stroke: first reaches its stop at t = 11 s or earlier, with a force of at least 150 kN"
    )
    assert "outputs 0.5 s apart, from t = 10 s on" in said


def test_no_touch_no_stops_and_failed_cylinders_are_not_told_of(rig):
    time, reach = np.arange(3.0), np.full((3, rig.count), 2.0)
    assert stops_touched(rig, reach, time) == []
    beyond = reach.copy()
    beyond[:, 0] = 2.5
    assert stops_touched(rig, beyond, time)
    assert stops_touched(rig.replaced(failed=[0]), beyond, time) == []
    assert stops_touched(rig.replaced(stroke=None), beyond, time) == []


@pytest.mark.parametrize("seed", range(8))
def test_a_cylinder_that_fails_pushes_at_no_stop_afterwards(rig, seed):
    """As if it had failed from the start, if it is beyond the stop only after it fails."""
    draw = np.random.default_rng(seed)
    time, one = np.linspace(0.0, 10.0, 101), int(draw.integers(rig.count))
    reach = np.zeros((101, rig.count))
    reach[:, one] = np.where(time > draw.uniform(3.0, 7.0), 2.5, 0.0)
    first = float(time[(reach[:, one] > 2.0).argmax()])
    for at, touches in ((first - 0.05, False), (first + 0.05, True)):
        failing = Failing(at=f"{at} s", cylinders=[one])
        assert bool(stops_touched(rig.replaced(failing=failing), reach, time)) == touches


def test_a_touch_at_rest_is_told(rig):
    (said,) = sentences(stops_touched(rig, np.full(rig.count, -2.01)))
    assert said == "stroke: reaches its stop in static equilibrium, with 500 kN a cylinder"


@pytest.mark.parametrize("amplitude", ["0.1 m", "3 m"])
def test_a_run_tells_when_it_touches(amplitude):
    run = simulate(load_scene(HEAVE, **RUN | {"platform.heave.amplitude": amplitude}))
    told = [w for w in json.loads(run.attrs["warnings"]) if w.startswith("stroke")]
    reach = abs(run["tensioner_stroke"]).max("cylinder")
    touched = reach["time"].values[reach.values > 2.0]
    assert len(told) == (len(touched) > 0) == (amplitude == "3 m")
    if told:
        first = float(told[0].partition("stop at t = ")[2].partition(" s")[0])
        assert touched[0] - 0.1 < first <= touched[0]


@pytest.mark.parametrize("period, amplitude", [("10 s", "3 m"), ("8 s", "2.5 m"), ("14 s", "4 m")])
def test_warnings_of_stops_do_not_depend_on_the_outputs(period, amplitude):
    told = []
    for interval in ("0.1 s", "1 s", "7 s"):
        motion = {"platform.heave.period": period, "platform.heave.amplitude": amplitude}
        analysis = RUN["analysis"] | {"output": {"interval": interval}}
        run = simulate(load_scene(HEAVE, **RUN | motion | {"analysis": analysis}))
        told.append([w for w in json.loads(run.attrs["warnings"]) if w.startswith("stroke")])
    assert len(told[0]) == 1
    assert told[0] == told[1] == told[2]
