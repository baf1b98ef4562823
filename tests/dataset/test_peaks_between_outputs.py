"""Statistics by few outputs in a period, beside those by many: of Gaussian processes, and of real rigs."""

import csv
import math
from functools import cache

import numpy as np
import pytest
from random_rigs import moving, written

from riserstudy import simulate
from riserstudy.cli import main
from riserstudy.dataset.statistics import record_statistics
from riserstudy.scene.load import SceneFile

PERIOD, OFTEN = 10.0, 400  # s; outputs in the shortest period
EXPOSURE = 10800.0


@cache
def gaussian(seed, slowest):
    """A process of deviation 1 whose periods are from 10 s to ``slowest`` times as long, often output.

    Its times, values and statistics.
    """
    draw = np.random.default_rng(seed)
    w = 2.0 * math.pi / PERIOD * draw.uniform(1.0 / slowest, 1.0, 200)
    time = np.arange(0.0, 1800.0, PERIOD / OFTEN)
    phase = draw.uniform(0.0, 2.0 * math.pi, len(w))
    values = sum(np.cos(a * time + b) for a, b in zip(w, phase, strict=True))
    values *= math.sqrt(2.0 / len(w))
    return time, values, record_statistics(time, values, EXPOSURE)


@pytest.mark.parametrize("outputs", [4, 5, 8, 10, 16, 20])
@pytest.mark.parametrize("slowest", [1.2, 3.0])
@pytest.mark.parametrize("seed", range(3))
def test_few_outputs_have_the_statistics_of_many(seed, slowest, outputs):
    time, values, whole = gaussian(seed, slowest)
    few = slice(seed, None, OFTEN // outputs)
    told = record_statistics(time[few], values[few], EXPOSURE)
    for name in ("largest", "smallest", "most_probable_largest", "most_probable_smallest", "period"):
        assert getattr(told, name) == pytest.approx(getattr(whole, name), rel=0.015), name


@pytest.mark.parametrize("outputs", [4.0, 4.3, 5.0, 7.7, 14.0])
@pytest.mark.parametrize("seed", range(3))
def test_few_outputs_of_a_regular_motion_have_its_range_and_period(seed, outputs):
    draw = np.random.default_rng(seed)
    time = np.arange(0.0, 30.0 * PERIOD, PERIOD / outputs)
    told = record_statistics(time, np.sin(2.0 * math.pi * (time / PERIOD + draw.uniform())), EXPOSURE)
    assert told.period == pytest.approx(PERIOD, rel=1e-3)
    for value in (told.largest, -told.smallest, told.most_probable_largest):
        assert value == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("seed", range(5))
def test_an_impulse_does_not_make_values_far_beyond_the_outputs(seed):
    """A jump of one output: a spline without a limit overshoots by a fifth."""
    draw = np.random.default_rng(seed)
    values = np.where(np.arange(200) < draw.integers(50, 150), 0.0, 1.0)
    told = record_statistics(np.arange(200.0), values, EXPOSURE)
    assert (told.largest, -told.smallest) == (pytest.approx(1.0, abs=0.21), pytest.approx(0.0, abs=0.21))


def statistics(tree, folder, monkeypatch):
    """Smallest and largest value of each history of a rig, by its name and place."""
    run, out = folder / "run.nc", folder / "out.csv"
    simulate(SceneFile("rig.yaml", written(tree)), progress=False).to_netcdf(run)
    words = ["riserstudy", "statistics", str(run), "-o", str(out), "--force"]
    monkeypatch.setattr("sys.argv", words)
    main()
    with out.open() as file:
        rows = list(csv.DictReader(file))
    return {(r["output"], r["s (m)"]): np.array([float(r[k]) for k in ("smallest", "largest")]) for r in rows}


@pytest.mark.parametrize("outputs", [4, 8])
@pytest.mark.parametrize("seed", range(4))
def test_extremes_of_a_rig_are_those_of_all_steps_or_warned_of(seed, outputs, tmp_path, monkeypatch, capsys):
    tree = moving(seed, spatial=bool(seed % 2))
    period = tree["platform"]["surge"]["period"]
    tree["analysis"] = {
        "duration": 6.0 * period,
        "step": period / 64.0,
        "mesh": {"elements": 20},
        "output": {"interval": period / 64.0},
    }
    whole = statistics(tree, tmp_path, monkeypatch)
    capsys.readouterr()
    tree["analysis"]["output"]["interval"] = period / outputs
    few = statistics(tree, tmp_path, monkeypatch)
    if "miss peaks" in capsys.readouterr().err:
        return
    for key, ends in whole.items():
        if "tensioner" not in key[0] and np.ptp(ends) > 1e-6 * abs(ends).max():
            assert np.abs(few[key] - ends).max() <= 0.05 * np.ptp(ends), key
