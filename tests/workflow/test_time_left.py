"""Time left of whole runs: recorded times of steps replayed, predicted against true.

Runs differ from the recorded one in the speed of the machine, in what each step takes, in their order and
in how many steps are at work at once. None of that is told to what predicts.
"""

import json
from pathlib import Path

import numpy as np
import pytest

from riserstudy.jobs.points_done import PointsDone
from riserstudy.jobs.progress import Progress
from riserstudy.jobs.step_times import StepName, first_times

CORES = 2
LOOK = 10.0  # s between looks
SURE = 180.0  # s from which on the time left is to be right
RIGHT = 0.2
SCATTER = 0.3  # standard deviation of the logarithm of what a step takes
OTHERS = {"derive": 71, "figure": 104, "grade": 5, "reproduction": 1, "database": 1, "report": 1}


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


def steps_of_a_run(seed, speed):
    """Name and core seconds of every step, in order: kernels, studies, what reads them."""
    first = first_times()
    draw = np.random.default_rng(seed)
    every = [(name, taken.seconds) for name, taken in first.steps.items()]
    compiled = [step for step in every if step[0].rule == "compile"]
    others = [step for step in every if step[0].rule != "compile"]
    draw.shuffle(others)
    readers = [
        (StepName.of(rule, {"paper": "paper", "study": k}), first.a_step[rule])
        for rule, count in OTHERS.items()
        for k in range(count)
    ]
    return [
        (name, seconds * speed * draw.lognormal(-(SCATTER**2) / 2.0, SCATTER))
        for name, seconds in (*compiled, *others, *readers)
    ]


def looks(progress, clock, steps, points, together):
    """Replay a run, ``together`` steps at once, each with its part of the cores: time and time left."""
    waiting = list(enumerate(steps))
    at_work, said, look = {}, [], 0.0
    while waiting or at_work:
        while waiting and len(at_work) < together:
            job, (name, seconds) = waiting.pop(0)
            progress.begin(job, name, log=log_of(name))
            at_work[job] = [name, seconds, seconds]
        rate = CORES / len(at_work)
        until_end = min(left for *_, left in at_work.values()) / rate
        ahead = min(until_end, look - clock.now)
        clock.now += ahead
        for step in at_work.values():
            step[2] -= ahead * rate
        if clock.now >= look:
            tell_points(at_work.values(), points)
            said.append((clock.now, progress.seconds_left()))
            look += LOOK
        for job in [j for j, step in at_work.items() if step[2] <= 1e-9]:
            del at_work[job]
            progress.end(job)
    return said


def log_of(name):
    """The log of a step."""
    return Path(f"logs/{name.study}.log") if name.study else None


def tell_points(at_work, points):
    """Write into the logs of studies at work how many of their points are done."""
    for name, seconds, left in at_work:
        if name.rule == "simulate":
            log = log_of(name)
            log.parent.mkdir(parents=True, exist_ok=True)
            of = round(points[name.study])
            log.write_text(f"{PointsDone(int(of * (1.0 - left / seconds)), of)}\n")


def planned(path):
    """Points of the studies of the recorded run, left where a plan leaves them."""
    steps = first_times().steps
    points = {name.study: taken.points for name, taken in steps.items() if name.rule == "simulate"}
    path.write_text(json.dumps({study: (count, 1) for study, count in points.items()}))
    return points


def counts(steps):
    rules = [name.rule for name, _ in steps]
    return {rule: rules.count(rule) for rule in rules}


@pytest.mark.parametrize("together", [1, 2])
@pytest.mark.parametrize("speed", [0.6, 1.0, 1.6])
@pytest.mark.parametrize("seed", [1, 2])
def test_a_first_run_is_right_from_the_third_minute(tmp_path, monkeypatch, seed, speed, together):
    monkeypatch.chdir(tmp_path)
    points = planned(tmp_path / "points.json")
    clock = Clock()
    progress = Progress("standard", tmp_path / "steps.json", clock, tmp_path / "points.json")
    steps = steps_of_a_run(seed, speed)
    progress.plan(counts(steps))
    progress.cores = CORES
    said = looks(progress, clock, steps, points, together)
    wrong = [
        (now, left) for now, left in said
        if now >= SURE and abs((now + left) / clock.now - 1.0) > RIGHT
    ]  # fmt: skip
    assert len(said) > 50
    assert not wrong, f"of {clock.now:.0f} s in all"


@pytest.mark.parametrize("seed", [3, 4])
def test_a_second_run_is_right_from_its_first_look(tmp_path, monkeypatch, seed):
    """The same steps, first one at a time, then two: whatever cores they use, their parts add up."""
    monkeypatch.chdir(tmp_path)
    points = planned(tmp_path / "points.json")
    clock = Clock()
    steps = steps_of_a_run(seed, 1.5)
    for together in (1, 2):
        clock.now = 0.0
        progress = Progress("standard", tmp_path / "steps.json", clock, tmp_path / "points.json")
        progress.plan(counts(steps))
        progress.cores = CORES
        said = looks(progress, clock, steps, points, together)
        progress.remember()
    wrong = [left for now, left in said if abs((now + left) / clock.now - 1.0) > 0.03]
    assert not wrong


@pytest.mark.parametrize("seconds", [1e-4, 3e-3, 0.2])
@pytest.mark.parametrize("seed", [5, 6])
def test_a_study_in_shards_is_right_after_three_of_them(tmp_path, monkeypatch, seed, seconds):
    """A million points that no run had, in 50 jobs: whatever a point takes, shards tell the rest."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "points.json").write_text('{"mine/grid": [1000000, 50], "mine/other": [40, 1]}')
    draw = np.random.default_rng(seed)
    steps = [
        (StepName.of_study("mine/grid", k + 1, 50), 2e4 * seconds * draw.lognormal(0.0, 0.1))
        for k in draw.permutation(50)
    ]
    steps += [(StepName.of_study("mine/other"), 3.0)]
    steps += [(StepName.of_study("mine/grid"), 1e6 * first_times().a_point["join"])]
    clock = Clock()
    progress = Progress("standard", tmp_path / "steps.json", clock, tmp_path / "points.json")
    progress.plan(counts(steps))
    progress.cores = CORES
    wrong = []
    for job, (name, lasts) in enumerate(steps):
        progress.begin(job, name)
        clock.now += lasts / CORES
        progress.end(job)
        if job >= 2:
            left = sum(of for *_, of in steps[job + 1 :]) / CORES
            said = progress.seconds_left() or 0.0
            if abs(said - left) > RIGHT * (left + clock.now):
                wrong.append((job, left, said))
    assert not wrong
