"""Time left of whole runs: recorded times of steps replayed, predicted against true.

Runs differ from the recorded one in the speed of the machine, in what each step takes, in their order and
in how many steps are at work at once. None of that is told to what predicts.
"""

import json
from pathlib import Path

import numpy as np
import pytest

from riserstudy.jobs.progress import FIRST, Progress

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
    """Message, rule and core seconds of every step, in order: kernels, studies, what reads them."""
    first = json.loads(FIRST.read_text("utf-8"))
    draw = np.random.default_rng(seed)
    every = [(m, rule, seconds) for m, (rule, seconds, _) in first["steps"].items()]
    compiled = [step for step in every if step[1] == "compile"]
    others = [step for step in every if step[1] != "compile"]
    draw.shuffle(others)
    readers = [
        (f"{rule} paper/{k}", rule, first["a_step"][rule])
        for rule, count in OTHERS.items()
        for k in range(count)
    ]
    return [
        (message, rule, seconds * speed * draw.lognormal(-(SCATTER**2) / 2.0, SCATTER))
        for message, rule, seconds in (*compiled, *others, *readers)
    ]


def looks(progress, clock, steps, points, together):
    """Replay a run, ``together`` steps at once, each with its part of the cores: time and time left."""
    waiting = list(enumerate(steps))
    at_work, said, look = {}, [], 0.0
    while waiting or at_work:
        while waiting and len(at_work) < together:
            job, (message, rule, seconds) = waiting.pop(0)
            progress.begin(job, message)
            at_work[job] = [message, rule, seconds, seconds]
        rate = CORES / len(at_work)
        until_end = min(left for *_, left in at_work.values()) / rate
        ahead = min(until_end, look - clock.now)
        clock.now += ahead
        for step in at_work.values():
            step[3] -= ahead * rate
        if clock.now >= look:
            tell_points(at_work.values(), points)
            said.append((clock.now, progress.seconds_left()))
            look += LOOK
        for job in [j for j, step in at_work.items() if step[3] <= 1e-9]:
            progress.end(job, at_work.pop(job)[1])
    return said


def tell_points(at_work, points):
    """Write into the logs of studies at work how many of their points are done."""
    for message, rule, seconds, left in at_work:
        if rule == "simulate":
            study = message.removeprefix("simulate ")
            log = Path(f"logs/{study}.log")
            log.parent.mkdir(parents=True, exist_ok=True)
            of = round(points[study])
            log.write_text(f"{int(of * (1.0 - left / seconds))} of {of} points\n")


def planned(path):
    """Points of the studies of the recorded run, left where a plan leaves them."""
    first = json.loads(FIRST.read_text("utf-8"))
    points = {
        message.removeprefix("simulate "): count
        for message, (rule, _, count) in first["steps"].items()
        if rule == "simulate"
    }
    path.write_text(json.dumps({study: (count, 1) for study, count in points.items()}))
    return points


def counts(steps):
    rules = [rule for _, rule, _ in steps]
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
    first = json.loads(FIRST.read_text("utf-8"))
    draw = np.random.default_rng(seed)
    steps = [
        (f"simulate mine/grid, part {k} of 50", "shard", 2e4 * seconds * draw.lognormal(0.0, 0.1))
        for k in draw.permutation(50)
    ]
    steps += [("simulate mine/other", "simulate", 3.0)]
    steps += [("simulate mine/grid", "simulate", 1e6 * first["a_point"]["join"])]
    clock = Clock()
    progress = Progress("standard", tmp_path / "steps.json", clock, tmp_path / "points.json")
    progress.plan(counts(steps))
    progress.cores = CORES
    wrong = []
    for job, (message, rule, lasts) in enumerate(steps):
        progress.begin(job, message)
        clock.now += lasts / CORES
        progress.end(job, rule)
        if job >= 2:
            left = sum(of for *_, of in steps[job + 1 :]) / CORES
            said = progress.seconds_left() or 0.0
            if abs(said - left) > RIGHT * (left + clock.now):
                wrong.append((job, left, said))
    assert not wrong
