"""The longest step of a prescribed run and the first step of a refinement: fractions of periods."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from riserstudy.errors import SimulationError
from riserstudy.simulation import prescribed_run, refinement
from riserstudy.simulation.prescribed_run import refuse_unseen_periods
from riserstudy.simulation.remaining_error import MOST_FALL


def scene(step, duration=100.0, regular=None, shortest=None):
    """A scene by what these rules need of it."""
    analysis = SimpleNamespace(step=step, duration=duration)
    return SimpleNamespace(analysis=analysis, shortest_regular_period=regular, shortest_period=shortest)


@pytest.mark.parametrize("seed", range(10))
def test_a_step_up_to_a_quarter_of_a_regular_period_is_allowed(seed):
    draw = np.random.default_rng(seed)
    period = float(draw.uniform(0.5, 30.0))
    for factor in (0.25 * (1.0 + 1e-12), 0.25, float(draw.uniform(0.01, 0.25))):
        refuse_unseen_periods(scene(factor * period, regular=period))
    long = float(draw.uniform(0.2501, 3.0)) * period
    with pytest.raises(SimulationError, match=r"more than a quarter of .* give a step of at most") as told:
        refuse_unseen_periods(scene(long, regular=period))
    advised = float(str(told.value).split("at most ")[1].split(" s")[0])
    assert 0.24 * period <= advised <= 0.25 * period
    refuse_unseen_periods(scene(advised, regular=period))
    refuse_unseen_periods(scene(long, regular=None))  # of irregular waves
    refuse_unseen_periods(scene(long, duration=None, regular=period))  # at rest
    refuse_unseen_periods(scene(None, regular=period))  # the engine chooses


@pytest.mark.parametrize("seed", range(10))
def test_the_decrease_that_is_believed_grows_with_the_steps_in_a_period(seed):
    """With few steps in the shortest period, less of a decrease by halving is used, along the riser least."""
    draw = np.random.default_rng(seed)
    period = float(draw.uniform(0.5, 30.0))
    most = [
        prescribed_run._trusted(scene(period / n, shortest=period))
        for n in (7.9, 8.0, 23.9, 24.0, 95.9, 96.0)
    ]
    assert [of for of, _ in most[1:]] == [2.0, 2.0] + [MOST_FALL] * 3
    assert most[0][0] < 2.0
    assert [bool(along) for _, along in most] == [True] * 5 + [False]
    assert all(along.get("tension", 2.0) == 2.0 for _, along in most)
    assert prescribed_run._trusted(scene(0.1)) == (MOST_FALL, {})  # nothing moves


@pytest.mark.parametrize("seed", range(10))
def test_the_first_step_of_a_refinement_is_a_share_of_a_period_and_of_a_coupling(seed, monkeypatch):
    draw = np.random.default_rng(seed)
    period, interval = (float(x) for x in draw.uniform(0.5, 30.0, 2))
    monkeypatch.setattr(refinement, "period", lambda _: period)
    alone = refinement._longest_step(SimpleNamespace(vessel=None))
    assert alone == pytest.approx(period / 24.0)
    vessel = SimpleNamespace(coupling=SimpleNamespace(interval=interval))
    coupled = refinement._longest_step(SimpleNamespace(vessel=vessel))
    assert coupled <= alone * (1.0 + 1e-9)
    steps = interval / coupled
    assert steps == pytest.approx(round(steps))
    assert round(steps) <= math.ceil(interval / alone - 1e-9)


@pytest.mark.parametrize("ways", [["step"], ["mesh"], ["mesh", "step"], []])
@pytest.mark.parametrize("seed", range(3))
def test_each_coarser_run_doubles_step_or_segments_alone(seed, ways, monkeypatch):
    draw = np.random.default_rng(seed)
    elements, step = int(draw.integers(4, 300)), float(draw.uniform(0.01, 1.0))
    monkeypatch.setattr(prescribed_run, "prescribed", lambda _, n: SimpleNamespace(l0=np.ones(n)))
    monkeypatch.setattr(prescribed_run, "thinned", lambda of, _: (of, True))
    monkeypatch.setattr(prescribed_run, "march", lambda _, mesh, step, **__: (len(mesh.l0), step))
    watch = SimpleNamespace(begin=lambda _: None)
    runs = prescribed_run._coarser(scene(step), elements, ways, watch)
    now, made = (elements, step), []
    for way, _, found in runs:
        now = (now[0] // 2, now[1]) if way == "mesh" else (now[0], 2.0 * now[1])
        assert found == now
        made.append(way)
    assert {way: made.count(way) for way in ways} == dict.fromkeys(ways, 2)
    assert len(made) == 2 * len(ways)
