"""Scenes that no run could end with are refused, or broken off, with a line that says so."""

import math
import random
from contextlib import suppress
from pathlib import Path

import pytest

from riserstudy.errors import InputError, RiserStudyError
from riserstudy.model.sea import wave_number
from riserstudy.scene.load import read_scene
from riserstudy.scene.paths import leaves
from riserstudy.simulation.refine import run

SCENES = Path(__file__).parents[2] / "config/scenes"
SURGE = SCENES / "bench/s2.yaml"
ENDLESS = ["1e-30 s", "1e-12 s", "1e-7 s", "1e-6 s"]


@pytest.mark.parametrize("period", ENDLESS)
@pytest.mark.parametrize("command", ["run", "cost", "check"])
def test_a_period_of_next_to_nothing_is_refused_in_a_line(commands, tmp_path, command, period):
    words = [command, SURGE, "--set", f"platform.surge.period={period}"]
    words += ["--set", "limits=[{output: bending_moment, largest: 1 MN*m, mode: drilling}]"]
    words += {"run": ["-o", tmp_path / "a.nc", "--accuracy", "1%"], "cost": []}.get(
        command, ["--accuracy", "1%"]
    )
    code, out, error = commands(*words)
    assert (code, out, error.count("\n")) == (2, "", 1)
    assert "give a shorter duration or a longer period" in error


def test_a_cost_that_takes_long_is_told_of_and_ends(commands, monkeypatch):
    monkeypatch.setattr("riserstudy.advice.accuracy_cost.PATIENCE", 2.0)
    monkeypatch.setattr("riserstudy.simulation.progress_line.LATE", 0.5)
    code, out, error = commands("cost", SURGE, "--set", "platform.surge.period=1e-5 s")
    assert (code, out) == (3, "")
    assert "segments, steps of" in error.splitlines()[0]
    assert "within the time limit of 2 s" in error.splitlines()[-1]


@pytest.mark.parametrize("option", ["--weight", "--buoyancy", "--tension-ratio"])
@pytest.mark.parametrize("value", ["inf", "nan", "-inf", "1e400"])
def test_a_tolerance_of_the_minimum_tension_is_a_finite_number(commands, option, value):
    words = {"--units": "6", "--failed": "0", "--tension-ratio": "0.95", "--weight": "1.05"}
    words |= {"--buoyancy": "0.96", option: value}
    scene = SCENES / "design/riser.yaml"
    code, out, error = commands("tension", scene, *(x for pair in words.items() for x in pair))
    assert (code, out, error.count("\n")) == (2, "", 1)


@pytest.mark.parametrize("seed", range(40))
def test_times_of_any_size_end_a_run_or_are_refused(seed):
    rng = random.Random(seed)
    file = read_scene(rng.choice(sorted(SCENES.glob("*/*.yaml"))))
    times = [p for p, v in leaves(file.tree) if isinstance(v, str) and v.endswith((" s", " min"))]
    if not times:
        return
    values = {path: f"{10 ** rng.uniform(-30, 29):g} s" for path in rng.sample(times, 1)}
    if rng.random() < 0.5:
        values |= {"analysis.mesh": None, "analysis.step": None, "analysis.accuracy": "5 %"}
    with suppress(RiserStudyError):
        run(file.with_values(values, "test").resolved(), patience=0.5)


@pytest.mark.parametrize("seed", range(20))
def test_a_wave_number_meets_its_equation_for_waves_of_any_length(seed):
    rng = random.Random(seed)
    depth, period = 10 ** rng.uniform(0, 4), 10 ** rng.uniform(-1, 25)
    k = wave_number(2.0 * math.pi / period, depth, 9.81)
    assert 9.81 * k * math.tanh(k * depth) == pytest.approx((2.0 * math.pi / period) ** 2, rel=1e-6)


def test_a_duration_within_the_bound_is_no_fault():
    file = read_scene(SURGE).with_values({"platform.surge.period": "1e-5 s"}, "test")
    assert file.resolved()
    with pytest.raises(InputError):
        file.with_values(
            {"analysis.duration": "401 s", "analysis.mesh": None, "analysis.step": None}, "test"
        ).resolved()
